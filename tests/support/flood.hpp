// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "skeleton/plain_regions.hpp"

namespace ridgeway::testing {

using detail::Regions;
using detail::regions_at;

}  // namespace ridgeway::testing
