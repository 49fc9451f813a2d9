// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Whether a path can be deformed into another with the same ends by uniform visibility (Zhou et
/// al. 2020): the points at equal shares of their lengths see each other. They need to at three
/// quarters of the radius alone, since tight paths touch the radius at corners, and are looked at
/// every half radius; so the surface between the paths keeps half a radius from all obstacles. For
/// robots smaller than a quarter of a voxel at every eighth of a voxel, which no voxel fits
/// between.
bool deforms_into(const FreeSpace& space, std::span<const Point> a, std::span<const Point> b,
                  double radius);

}  // namespace ridgeway::detail
