// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "canvas.hpp"
#include "picture_frame.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr double kOnAPower = 1e-6;  // of ten; an axis ends at a value so near to it

struct Axis {
  bool log = false;
  double low = 0.0, high = 1.0;  // of the values, or of their logarithms
  double at(double value) const { return log ? std::log10(value) : value; }
  double share(double value) const { return (at(value) - low) / (high - low); }
};

void require_drawable(const ScatterChart& chart) {
  const auto fail = [&](const char* problem, const char* remedy) {
    throw InputError("chart '" + chart.title + "'", problem, remedy);
  };
  std::size_t count = 0;
  for (const ScatterSeries& series : chart.series)
    for (const auto& [x, y] : series.points) {
      if (std::isnan(y)) continue;
      ++count;
      if (!std::isfinite(x) || !std::isfinite(y)) fail("has a value that is no number", "drop it");
      if ((chart.log_x && x <= 0.0) || (chart.log_y && y <= 0.0))
        fail("has a value not above 0 on an axis of powers", "drop it");
    }
  if (count == 0) fail("has no points", "give at least one");
  if (chart.series.size() > kSeriesColours.size())
    fail("has more than eight series", "draw two charts");
  if (chart.width < 300 || chart.width > 8000) fail("is too small or large", "300 to 8000 pixels");
}

template <typename Value>
Axis axis_of(const ScatterChart& chart, bool log, const Value& value) {
  Axis axis{log, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const ScatterSeries& series : chart.series)
    for (const auto& point : series.points) {
      if (std::isnan(point.second)) continue;
      axis.low = std::min(axis.low, axis.at(value(point)));
      axis.high = std::max(axis.high, axis.at(value(point)));
    }
  if (log) {
    axis.low = std::floor(axis.low + kOnAPower);
    axis.high = std::max(std::ceil(axis.high - kOnAPower), axis.low + 1.0);
  } else {
    axis.low = std::min(axis.low, 0.0);
    axis.high += axis.high > axis.low ? 0.08 * (axis.high - axis.low) : 1.0;
  }
  return axis;
}

/// Round values along an axis, in ascending order.
std::vector<double> ticks_of(const Axis& axis) {
  std::vector<double> ticks;
  if (axis.log) {
    for (double power = axis.low; power <= axis.high; ++power)
      ticks.push_back(std::pow(10.0, power));
  } else {
    const double step = round_step((axis.high - axis.low) / 4.0);
    for (double k = std::ceil(axis.low / step); k * step <= axis.high; ++k)
      ticks.push_back(k * step);
  }
  return ticks;
}

struct ScatterPlot {
  double left, top, width, height, unit;
  Axis across, up;
  double x(double value) const { return left + width * across.share(value); }
  double y(double value) const { return top + height * (1.0 - up.share(value)); }
};

void stroke(Canvas& canvas, double x0, double y0, double x1, double y1) {
  cairo_move_to(canvas.cairo(), x0, y0);
  cairo_line_to(canvas.cairo(), x1, y1);
  cairo_stroke(canvas.cairo());
}

void draw_axes(Canvas& canvas, const ScatterChart& chart, const ScatterPlot& plot) {
  const double u = plot.unit, bottom = plot.top + plot.height;
  canvas.set_font(15.0 * u);
  canvas.set_line(u);
  for (const double tick : ticks_of(plot.up)) {
    canvas.set_colour(ink::kUnknown);
    stroke(canvas, plot.left, plot.y(tick), plot.left + plot.width, plot.y(tick));
    canvas.set_colour(ink::kFaint);
    canvas.draw_text(plot.left - 8.0 * u, plot.y(tick) + 5.0 * u, short_number(tick, 6),
                     Canvas::Align::kRight);
  }
  for (const double tick : ticks_of(plot.across)) {
    canvas.set_colour(ink::kUnknown);
    stroke(canvas, plot.x(tick), plot.top, plot.x(tick), bottom);
    canvas.set_colour(ink::kFaint);
    canvas.draw_text(plot.x(tick), bottom + 22.0 * u, short_number(tick, 6),
                     Canvas::Align::kMiddle);
  }
  canvas.set_colour(ink::kFrame);
  cairo_rectangle(canvas.cairo(), plot.left, plot.top, plot.width, plot.height);
  cairo_stroke(canvas.cairo());
  canvas.set_colour(ink::kText);
  canvas.draw_text(plot.left + 0.5 * plot.width, bottom + 48.0 * u, chart.x_label,
                   Canvas::Align::kMiddle);
  canvas.draw_text(plot.left, plot.top - 10.0 * u, chart.y_label);
}

void draw_point(Canvas& canvas, double x, double y, double unit) {
  cairo_arc(canvas.cairo(), x, y, 5.0 * unit, 0.0, 2.0 * M_PI);
  cairo_fill(canvas.cairo());
}

void draw_values(Canvas& canvas, const ScatterSeries& series, const ScatterPlot& plot) {
  if (series.style != SeriesStyle::kPoints) {
    for (const auto& [x, y] : series.points)
      if (std::isnan(y))
        cairo_new_sub_path(canvas.cairo());
      else
        cairo_line_to(canvas.cairo(), plot.x(x), plot.y(y));
    cairo_stroke(canvas.cairo());
  }
  if (series.style == SeriesStyle::kGuide) return;
  for (const auto& [x, y] : series.points)
    if (!std::isnan(y)) draw_point(canvas, plot.x(x), plot.y(y), plot.unit);
}

/// A line of the legend, to the right of the plot.
void draw_legend(Canvas& canvas, const ScatterSeries& series, const ScatterPlot& plot,
                 std::size_t index) {
  const double u = plot.unit, x = plot.left + plot.width + 24.0 * u;
  const double y = plot.top + (12.0 + 28.0 * static_cast<double>(index)) * u;
  if (series.style != SeriesStyle::kPoints) stroke(canvas, x - 10.0 * u, y, x + 10.0 * u, y);
  if (series.style != SeriesStyle::kGuide) draw_point(canvas, x, y, u);
  canvas.set_colour(ink::kText);
  canvas.set_font(15.0 * u);
  canvas.draw_text(x + 14.0 * u, y + 5.0 * u, series.name);
}

void draw_series(Canvas& canvas, const ScatterChart& chart, const ScatterPlot& plot,
                 std::size_t index) {
  const ScatterSeries& series = chart.series[index];
  const double u = plot.unit;
  canvas.set_colour(kSeriesColours[index], 0.85);
  canvas.set_line(2.0 * u, series.style == SeriesStyle::kGuide
                               ? std::vector<double>{6.0 * u, 4.0 * u}
                               : std::vector<double>{});
  draw_values(canvas, series, plot);
  draw_legend(canvas, series, plot, index);
}

}  // namespace

void draw_scatter(const ScatterChart& chart, const std::filesystem::path& out) {
  require_drawable(chart);
  const double u = chart.width / 1000.0;
  Canvas canvas(out, chart.width, chart.width * 2 / 3);
  canvas.fill_rectangle(0.0, 0.0, chart.width, chart.width, ink::kHalo);
  double legend = 0.0;
  canvas.set_font(15.0 * u);
  for (const ScatterSeries& series : chart.series)
    legend = std::max(legend, canvas.text_width(series.name) + 50.0 * u);
  const ScatterPlot plot{80.0 * u,
                         92.0 * u,
                         chart.width - 100.0 * u - legend,
                         chart.width * 2.0 / 3.0 - 164.0 * u,
                         u,
                         axis_of(chart, chart.log_x, [](const auto& p) { return p.first; }),
                         axis_of(chart, chart.log_y, [](const auto& p) { return p.second; })};
  canvas.set_colour(ink::kText);
  canvas.set_font(22.0 * u, true);
  canvas.draw_text(plot.left, 40.0 * u, canvas.fitted(chart.title, chart.width - plot.left));
  draw_axes(canvas, chart, plot);
  for (std::size_t i = 0; i < chart.series.size(); ++i) draw_series(canvas, chart, plot, i);
  canvas.finish();
}

}  // namespace ridgeway
