// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

namespace ridgeway {

/// Throws InputError for a mesh of which Assimp 5.2 would read a part, and not say so: a wall that
/// is left out is a way for a robot. `format`: as mesh_format gives it; `name`: of the file.
void require_read_whole(std::string_view bytes, const std::string& format, const std::string& name);

}  // namespace ridgeway
