// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <utility>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::cli {

/// A start and a goal, world, between which there is a path for the smallest robot: far apart in
/// the largest part of space, for who has a map and knows no place of it. To the millimetre where
/// that does. Nothing where the graph is empty.
std::optional<std::pair<Point, Point>> example_query(const Roadmap& roadmap);

}  // namespace ridgeway::cli
