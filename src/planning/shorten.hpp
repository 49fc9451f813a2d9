// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

double length_of(const std::vector<Point>& path);

/// Pulls a free path tight: greedily skips waypoints while the straight segment is free, then
/// draws each remaining corner towards the line between its neighbours as far as it stays free,
/// until that gains less than a thousandth. Every segment of the result is free at the radius.
/// `may_replace`: whether a stretch of the path may become another with the same ends; null: any.
using MayReplace = std::function<bool(std::span<const Point>, std::span<const Point>)>;
std::vector<Point> shorten(const FreeSpace& space, std::vector<Point> path, double radius,
                           const Deadline& deadline, const MayReplace& may_replace = {});

/// Looks past the corners of a shortened path: where a stretch of it is much longer than the
/// straight line, tries ways on other sides of what blocks the line, and keeps those that are
/// shorter.
std::vector<Point> redirect(const EsdfMap& esdf, const FreeSpace& space, std::vector<Point> path,
                            double radius, const Deadline& deadline);

}  // namespace ridgeway::detail
