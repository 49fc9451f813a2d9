// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "chart.hpp"

#include <algorithm>
#include <cmath>

#include "picture_frame.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr double kChartTitle = 30.0, kPlot = 130.0, kGap = 14.0,
                 kChartAxis = 44.0;  // heights, units

/// Where a chart's values lie on the page.
struct Plot {
  double left, top, width, height;
  double longest, highest;  ///< time and value at the right and the top

  double x(double time) const { return left + width * time / longest; }
  double y(double value) const { return top + height * (1.0 - value / highest); }
};

double highest_of(const Chart& chart) {
  double highest = chart.limit.value_or(0.0);
  for (const double value : chart.values)
    if (std::isfinite(value)) highest = std::max(highest, value);
  return highest > 0.0 ? 1.12 * highest : 1.0;
}

void stroke_line(Canvas& canvas, double x0, double y0, double x1, double y1) {
  cairo_move_to(canvas.cairo(), x0, y0);
  cairo_line_to(canvas.cairo(), x1, y1);
  cairo_stroke(canvas.cairo());
}

void draw_grid(Canvas& canvas, const Plot& plot, bool with_times, double unit) {
  canvas.set_font(14.0 * unit);
  canvas.set_line(unit);
  const double rise = round_step(0.5 * plot.highest);
  for (double k = 0; k * rise <= plot.highest; ++k) {
    const double y = plot.y(k * rise);
    canvas.set_colour(ink::kUnknown);
    stroke_line(canvas, plot.left, y, plot.left + plot.width, y);
    canvas.set_colour(ink::kFaint);
    canvas.draw_text(plot.left - 8.0 * unit, y + 5.0 * unit, short_number(k * rise, 6),
                     Canvas::Align::kRight);
  }
  const double step = round_step(plot.longest / 5.0), bottom = plot.top + plot.height;
  for (double k = 0; k * step <= plot.longest; ++k) {
    const double x = plot.x(k * step);
    canvas.set_colour(ink::kUnknown);
    stroke_line(canvas, x, plot.top, x, bottom);
    canvas.set_colour(ink::kFaint);
    if (!with_times || x > plot.left + plot.width - 80.0 * unit) continue;
    canvas.draw_text(x, bottom + 20.0 * unit, short_number(k * step, 6), Canvas::Align::kMiddle);
  }
  if (with_times)
    canvas.draw_text(plot.left + plot.width, bottom + 20.0 * unit, "time (s)",
                     Canvas::Align::kRight);
}

void draw_limit(Canvas& canvas, const Chart& chart, const Plot& plot, double unit) {
  if (!chart.limit) return;
  canvas.set_colour(ink::kRawPath);
  canvas.set_line(1.5 * unit, {7.0 * unit, 5.0 * unit});
  stroke_line(canvas, plot.left, plot.y(*chart.limit), plot.left + plot.width,
              plot.y(*chart.limit));
  canvas.set_line(unit);
}

void draw_curve(Canvas& canvas, const Chart& chart, const Plot& plot, double unit) {
  bool drawing = false;
  for (std::size_t i = 0; i < chart.values.size(); ++i) {
    const bool shown = std::isfinite(chart.values[i]);
    const auto add = drawing ? cairo_line_to : cairo_move_to;
    if (shown) add(canvas.cairo(), plot.x(chart.times[i]), plot.y(chart.values[i]));
    drawing = shown;
  }
  canvas.set_colour(ink::kPath);
  canvas.set_line(2.5 * unit);
  cairo_stroke(canvas.cairo());
}

void draw_chart(Canvas& canvas, const Chart& chart, const Plot& plot, bool is_last, double unit) {
  canvas.set_colour(ink::kText);
  canvas.set_font(16.0 * unit);
  const double baseline = plot.top - 9.0 * unit;
  canvas.draw_text(plot.left, baseline, chart.label);
  if (chart.limit) {
    canvas.set_colour(ink::kRawPath);
    canvas.draw_text(plot.left + plot.width, baseline, chart.limit_label, Canvas::Align::kRight);
  }
  draw_grid(canvas, plot, is_last, unit);
  draw_limit(canvas, chart, plot, unit);
  draw_curve(canvas, chart, plot, unit);
  cairo_rectangle(canvas.cairo(), plot.left, plot.top, plot.width, plot.height);
  canvas.set_colour(ink::kFrame);
  canvas.set_line(1.5 * unit);
  cairo_stroke(canvas.cairo());
}

}  // namespace

void validate_charts(std::span<const Chart> charts) {
  for (const Chart& chart : charts)
    if (chart.times.size() != chart.values.size())
      throw InputError("chart '" + chart.label + "'", "has times and values of different numbers",
                       "give one value for each time");
}

double charts_height(std::size_t count, double unit) {
  return count == 0
             ? 0.0
             : (static_cast<double>(count) * (kChartTitle + kPlot + kGap) + kChartAxis) * unit;
}

void draw_charts(Canvas& canvas, std::span<const Chart> charts, double left, double top,
                 double width, double unit) {
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Chart& chart = charts[i];
    const double longest = chart.times.empty() ? 0.0 : chart.times.back();
    const Plot plot{
        left,
        top + (static_cast<double>(i) * (kChartTitle + kPlot + kGap) + kChartTitle) * unit,
        width,
        kPlot * unit,
        longest > 0.0 ? longest : 1.0,
        highest_of(chart)};
    draw_chart(canvas, chart, plot, i + 1 == charts.size(), unit);
  }
}

}  // namespace ridgeway
