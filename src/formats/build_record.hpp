// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {

/// What shapes a roadmap, for Roadmap::config: the same for the same build, whoever asked for it.
/// Lengths in metres. Limits of the flight and `least_apart` only where there are some.
nlohmann::ordered_json build_record(const BuildConfig& config, double voxel_size);

/// How the ridges of a roadmap were found, by its Roadmap::config; defaults for what that does not
/// say.
GvdConfig gvd_of_record(const std::string& record);

/// Boxes as six numbers, null where there is no limit.
nlohmann::ordered_json limits_record(const FlightLimits& limits);

}  // namespace ridgeway
