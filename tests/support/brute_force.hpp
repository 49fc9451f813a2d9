// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "esdf/plain_distances.hpp"

namespace ridgeway::testing {

using detail::all_obstacles;
using detail::brute_squared_distance;

}  // namespace ridgeway::testing
