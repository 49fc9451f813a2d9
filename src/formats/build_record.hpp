// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ridgeway/roadmap/build_roadmap.hpp"

namespace ridgeway {

/// What shapes a roadmap, for Roadmap::config: the same for the same build, whoever asked for it.
/// Lengths in metres.
nlohmann::ordered_json build_record(const BuildConfig& config, double voxel_size);

/// Boxes as six numbers, null where there is no limit.
nlohmann::ordered_json limits_record(const FlightLimits& limits);

}  // namespace ridgeway
