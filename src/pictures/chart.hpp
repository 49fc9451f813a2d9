// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>

#include "canvas.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway {

/// Throws InputError naming the chart that has not one value for each time.
void validate_charts(std::span<const Chart> charts);

/// Height of charts one under another, pixels; 0 for none.
double charts_height(std::size_t count, double unit);

/// Draws charts one under another, each from 0, with one axis of time below the last.
void draw_charts(Canvas& canvas, std::span<const Chart> charts, double left, double top,
                 double width, double unit);

}  // namespace ridgeway
