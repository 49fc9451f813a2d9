// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ridgeway {

/// How a series is drawn: points alone, points on a line, or a dashed line without points, which
/// others are compared with.
enum class SeriesStyle : std::uint8_t { kPoints, kLine, kGuide };

/// Values that belong together: one colour, and a line in the legend.
struct ScatterSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x, y; where y is NaN a line has a gap
  SeriesStyle style = SeriesStyle::kPoints;
};

/// Points over two axes; y runs in powers of ten where `log_y`, x where `log_x`.
struct ScatterChart {
  std::string title, x_label, y_label;
  std::vector<ScatterSeries> series;  ///< at most eight
  bool log_x = false, log_y = false;
  int width = 1000;  ///< pixels; the height is two thirds
};

/// Draws a chart as PNG or SVG, by the extension of `out`; whole or not at all. Throws InputError
/// for values that are not finite, or not above 0 on an axis of powers, or for no point at all.
void draw_scatter(const ScatterChart& chart, const std::filesystem::path& out);

}  // namespace ridgeway
