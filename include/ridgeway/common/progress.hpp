// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <string_view>

namespace ridgeway {

/// Called by long stages, from the calling thread, with the stage's name and the share done in
/// [0, 1]: at its beginning, and by those that can be cancelled anywhere (with_progress) some
/// twenty times a second meanwhile. Return false to cancel: the stage then throws `Cancelled`.
using Progress = std::function<bool(std::string_view stage, double share)>;

}  // namespace ridgeway
