// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Throws InputError for a radius (metres) that centres of voxels are not known to keep: above the
/// map's max_distance.
void require_known_distance(const EsdfMap& esdf, double radius);

/// Throws InputError, naming it, for a radius (metres) above largest_radius(esdf): what is nearer
/// than that is not known everywhere.
void require_known_radius(const EsdfMap& esdf, const char* name, double radius);

}  // namespace ridgeway::detail
