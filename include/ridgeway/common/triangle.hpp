// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>

namespace ridgeway {

/// The three vertices of a mesh that a triangle joins, counter-clockwise seen from its front.
using Triangle = std::array<std::uint32_t, 3>;

}  // namespace ridgeway
