// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>
#include <utility>

#include "ridgeway/sensing/world.hpp"

namespace ridgeway::detail {

/// The low and high corner of the smallest box around the space that is in front of all planes;
/// infinite in the directions in which they leave it open. Of more than 200 planes those along the
/// axes alone count.
std::pair<Point, Point> box_between(std::span<const SolidPlane> planes);

}  // namespace ridgeway::detail
