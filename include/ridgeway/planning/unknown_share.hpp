// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>

#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway {

/// The share of a path's length whose nearest obstacle is unknown space: what was never seen, and
/// may be free after all, decides there how far the path is from obstacles. From looks at the
/// middles of equal pieces of it.
double unknown_share(const EsdfMap& esdf, std::span<const Point> path);

}  // namespace ridgeway
