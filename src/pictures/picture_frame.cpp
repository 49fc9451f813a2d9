// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "picture_frame.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace ridgeway {
namespace {

constexpr double kSwatch = 34.0;   // width of a mark in the legend, units
constexpr double kMarkGap = 9.0;   // between a mark and its text
constexpr double kItemGap = 25.0;  // between items
constexpr double kLegendFont = 16.0;
constexpr double kTick = 6.0, kTickGap = 5.0;  // beside a map, and from there to its text
constexpr double kAxisFont = 14.0;
constexpr const char* kAxisNames[] = {"x (m)", "y (m)", "z (m)"};

double mark_width(LegendItem::Mark mark, double unit) {
  using Mark = LegendItem::Mark;
  return (mark == Mark::kDiagram || mark == Mark::kComponents ? 2.6 : 1.0) * kSwatch * unit;
}

void draw_swatch(Canvas& canvas, double x, double y, double unit, const Colour& colour) {
  const double h = 16.0 * unit;
  canvas.fill_rectangle(x, y - 0.5 * h, kSwatch * unit, h, colour);
  cairo_rectangle(canvas.cairo(), x, y - 0.5 * h, kSwatch * unit, h);
  canvas.set_colour(ink::kFrame);
  canvas.set_line(unit);
  cairo_stroke(canvas.cairo());
}

void draw_line(Canvas& canvas, double x0, double y0, double x1, double y1) {
  cairo_move_to(canvas.cairo(), x0, y0);
  cairo_line_to(canvas.cairo(), x1, y1);
  cairo_stroke(canvas.cairo());
}

void draw_ramp(Canvas& canvas, double x, double y, double width, double unit) {
  const double h = 12.0 * unit;
  for (int i = 0; i < 64; ++i) {
    canvas.fill_rectangle(x + width * i / 64.0, y - 0.5 * h, width / 64.0 + 0.5, h,
                          ramp_colour((i + 0.5) / 64.0));
  }
}

void draw_component_marks(Canvas& canvas, double x, double y, double width, double unit) {
  constexpr std::size_t kShown = 6;
  for (std::size_t i = 0; i < kShown; ++i)
    canvas.fill_rectangle(x + width * static_cast<double>(i) / kShown, y - 6.0 * unit,
                          width / kShown - unit, 12.0 * unit, component_colour(i));
}

void draw_mark(Canvas& canvas, const LegendItem& item, double x, double y, double unit) {
  using Mark = LegendItem::Mark;
  const double width = mark_width(item.mark, unit), middle = x + 0.5 * width;
  switch (item.mark) {
    case Mark::kFree:
      return draw_swatch(canvas, x, y, unit, ink::kFree);
    case Mark::kWall:
      return draw_swatch(canvas, x, y, unit, ink::kWall);
    case Mark::kUnknown:
      return draw_swatch(canvas, x, y, unit, ink::kUnknown);
    case Mark::kDiagram:
      return draw_ramp(canvas, x, y, width, unit);
    case Mark::kGraph:
      canvas.set_colour(ink::kGraph);
      canvas.set_line(1.6 * unit);
      draw_line(canvas, x, y, x + width, y);
      canvas.set_line(7.0 * unit);
      draw_line(canvas, x + 0.25 * width, y, x + 0.25 * width, y);
      return draw_line(canvas, x + 0.75 * width, y, x + 0.75 * width, y);
    case Mark::kPath:
      set_stroke(canvas, item.stroke, unit);
      draw_line(canvas, x, y, x + width, y);
      return canvas.set_line(unit);
    case Mark::kComponents:
      return draw_component_marks(canvas, x, y, width, unit);
    case Mark::kNoFly:
      return draw_no_fly(canvas, x, y - 8.0 * unit, width, 16.0 * unit, unit);
    case Mark::kKeepIn:
      return stroke_keep_in(canvas, x, y - 8.0 * unit, width, 16.0 * unit, unit);
    case Mark::kNarrow:
      return draw_narrow(canvas, middle, y, 7.0 * unit, unit);
    case Mark::kStart:
      return draw_start(canvas, middle, y, 0.8 * unit);
    case Mark::kGoal:
      return draw_goal(canvas, middle, y, 0.8 * unit);
  }
}

/// Those that are written along an axis, from its lowest on, which is so many pixels long: round
/// numbers, from 80 to 200 units apart.
std::vector<double> coordinates(const MapFrame& frame, double low, double pixels) {
  const double step = round_step(200.0 * frame.unit / frame.scale);
  std::vector<double> all;
  for (double k = std::ceil(low / step); k * step <= low + pixels / frame.scale; ++k)
    all.push_back(k * step);
  return all;
}

}  // namespace

bool MapFrame::clip(Point& a, Point& b) const {
  const double from = a[projection.along], to = b[projection.along];
  if (std::max(from, to) < range.low || std::min(from, to) > range.high) return false;
  const Point start = a, way = b - a;
  const auto share = [&](double at) { return std::clamp((at - from) / (to - from), 0.0, 1.0); };
  if (from == to) return true;
  const double first = share(from < to ? range.low : range.high),
               last = share(from < to ? range.high : range.low);
  a = start + first * way;
  b = start + last * way;
  return true;
}

void draw_no_fly(Canvas& canvas, double x, double y, double width, double height, double unit) {
  cairo_t* cairo = canvas.cairo();
  cairo_save(cairo);
  cairo_rectangle(cairo, x, y, width, height);
  canvas.set_colour(ink::kNoFly, 0.10);
  cairo_fill_preserve(cairo);
  cairo_clip(cairo);
  canvas.set_colour(ink::kNoFly, 0.75);
  canvas.set_line(1.4 * unit);
  for (double at = -height; at < width; at += 9.0 * unit)
    draw_line(canvas, x + at, y + height, x + at + height, y);
  cairo_restore(cairo);
  cairo_rectangle(cairo, x, y, width, height);
  canvas.set_colour(ink::kNoFly);
  canvas.set_line(2.6 * unit);
  cairo_stroke(cairo);
}

void stroke_keep_in(Canvas& canvas, double x, double y, double width, double height, double unit) {
  cairo_rectangle(canvas.cairo(), x, y, width, height);
  canvas.set_colour(ink::kNoFly);
  canvas.set_line(2.0 * unit, {9.0 * unit, 6.0 * unit});
  cairo_stroke(canvas.cairo());
  canvas.set_line(unit);
}

void draw_narrow(Canvas& canvas, double x, double y, double radius, double unit) {
  for (const bool is_rim : {true, false}) {
    cairo_arc(canvas.cairo(), x, y, radius, 0.0, 2.0 * std::numbers::pi);
    canvas.set_colour(is_rim ? ink::kHalo : ink::kNarrow, is_rim ? 0.9 : 1.0);
    canvas.set_line((is_rim ? 5.0 : 2.6) * unit);
    cairo_stroke(canvas.cairo());
  }
}

double round_step(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double lead : {5.0, 2.0}) {
    if (lead * power <= most) return lead * power;
  }
  return power;
}

std::string grouped(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string short_number(double value, int decimals) {
  std::array<char, 400> text;  // no number has as many digits
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  std::string number(text.data(), end.ptr);
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number == "-0" ? "0" : number;
}

std::string short_number_at_most(double value, int decimals) {
  constexpr double kRounding = 1e-9;  // 0.29 is 28.999999999999996 hundredths
  const double scale = std::pow(10.0, decimals);
  return short_number(std::floor(value * scale + kRounding) / scale, decimals);
}

void set_stroke(Canvas& canvas, const PathStroke& stroke, double unit) {
  std::vector<double> dashes = stroke.dashes;
  for (double& length : dashes) length *= unit;
  canvas.set_colour(stroke.colour);
  canvas.set_line(stroke.width * unit, dashes);
}

void draw_start(Canvas& canvas, double x, double y, double unit) {
  cairo_t* cairo = canvas.cairo();
  cairo_arc(cairo, x, y, 10.0 * unit, 0.0, 2.0 * std::numbers::pi);
  canvas.set_colour(ink::kStart);
  cairo_fill_preserve(cairo);
  canvas.set_colour(ink::kHalo);
  canvas.set_line(2.5 * unit);
  cairo_stroke(cairo);
}

void draw_goal(Canvas& canvas, double x, double y, double unit) {
  cairo_t* cairo = canvas.cairo();
  for (int i = 0; i < 10; ++i) {
    const double radius = (i % 2 == 0 ? 15.0 : 6.2) * unit;
    const double angle = i * std::numbers::pi / 5.0;
    cairo_line_to(cairo, x + radius * std::sin(angle), y - radius * std::cos(angle));
  }
  cairo_close_path(cairo);
  canvas.set_colour(ink::kHalo);
  canvas.set_line(5.0 * unit);
  cairo_stroke_preserve(cairo);
  canvas.set_colour(ink::kPath);
  cairo_fill(cairo);
}

LegendLayout lay_out_legend(Canvas& canvas, std::span<const LegendItem> items, double width,
                            double unit) {
  canvas.set_font(kLegendFont * unit);
  LegendLayout layout;
  double x = 0.0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double mark = mark_width(items[i].mark, unit) + kMarkGap * unit;
    layout.texts.push_back(
        canvas.fitted(items[i].text, width - mark - canvas.text_width(items[i].ending)) +
        items[i].ending);
    const double item = mark + canvas.text_width(layout.texts.back());
    if (layout.rows.empty() || x + item > width) {
      layout.rows.emplace_back();
      x = 0.0;
    }
    layout.rows.back().push_back(i);
    layout.offsets.push_back(x);
    x += item + kItemGap * unit;
  }
  return layout;
}

void draw_legend(Canvas& canvas, std::span<const LegendItem> items, const LegendLayout& layout,
                 double left, double top, double unit) {
  double y = top + 0.5 * legend_row_height(unit);
  for (const std::vector<std::size_t>& row : layout.rows) {
    for (const std::size_t i : row) {
      const double x = left + layout.offsets[i];
      draw_mark(canvas, items[i], x, y, unit);
      canvas.set_font(kLegendFont * unit);
      canvas.set_colour(ink::kText);
      canvas.draw_text(x + mark_width(items[i].mark, unit) + kMarkGap * unit, y + 5.5 * unit,
                       layout.texts[i]);
    }
    y += legend_row_height(unit);
  }
}

void draw_scale_bar(Canvas& canvas, const MapFrame& frame, double left, double top,
                    double most_pixels) {
  const double metres = round_step(most_pixels / frame.scale);
  const double length = metres * frame.scale, height = 7.0 * frame.unit;
  const double y = top + 0.5 * legend_row_height(frame.unit) - 0.5 * height;
  constexpr int kParts = 4;
  for (int i = 0; i < kParts; ++i) {
    canvas.fill_rectangle(left + length * i / kParts, y, length / kParts, height,
                          i % 2 == 0 ? ink::kText : ink::kHalo);
  }
  cairo_rectangle(canvas.cairo(), left, y, length, height);
  canvas.set_colour(ink::kText);
  canvas.set_line(frame.unit);
  cairo_stroke(canvas.cairo());
  canvas.set_font(15.0 * frame.unit);
  canvas.draw_text(left, y + height + 18.0 * frame.unit, "0", Canvas::Align::kMiddle);
  canvas.draw_text(left + length, y + height + 18.0 * frame.unit, short_number(metres, 6) + " m",
                   Canvas::Align::kMiddle);
}

void draw_border(Canvas& canvas, const MapFrame& frame) {
  const double u = frame.unit, tick = kTick * u;
  const double bottom = frame.top + frame.height, right = frame.left + frame.width;
  cairo_rectangle(canvas.cairo(), frame.left, frame.top, frame.width, frame.height);
  canvas.set_colour(ink::kFrame);
  canvas.set_line(1.5 * u);
  cairo_stroke(canvas.cairo());

  canvas.set_font(kAxisFont * u);
  const auto [across, up, along] = frame.projection;
  for (const double at : coordinates(frame, frame.min[across], frame.width)) {
    const double x = frame.left + (at - frame.min[across]) * frame.scale;
    canvas.set_colour(ink::kFrame);
    draw_line(canvas, x, bottom, x, bottom + tick);
    canvas.set_colour(ink::kFaint);
    if (x > right - 64.0 * u) continue;  // the axis' name stands there
    canvas.draw_text(x, bottom + tick + 15.0 * u, short_number(at, 6), Canvas::Align::kMiddle);
  }
  for (const double at : coordinates(frame, frame.min[up], frame.height)) {
    const double y = bottom - (at - frame.min[up]) * frame.scale;
    canvas.set_colour(ink::kFrame);
    draw_line(canvas, frame.left - tick, y, frame.left, y);
    canvas.set_colour(ink::kFaint);
    if (y < frame.top + 20.0 * u) continue;
    canvas.draw_text(frame.left - tick - kTickGap * u, y + 5.0 * u, short_number(at, 6),
                     Canvas::Align::kRight);
  }
  canvas.draw_text(right, bottom + tick + 15.0 * u, kAxisNames[across], Canvas::Align::kRight);
  canvas.draw_text(frame.left - tick - kTickGap * u, frame.top + 11.0 * u, kAxisNames[up],
                   Canvas::Align::kRight);
}

double border_width(Canvas& canvas, const MapFrame& frame) {
  canvas.set_font(kAxisFont * frame.unit);
  const int up = frame.projection.up;
  double widest = canvas.text_width(kAxisNames[up]);
  for (const double at : coordinates(frame, frame.min[up], frame.height))
    widest = std::max(widest, canvas.text_width(short_number(at, 6)));
  return widest + (kTick + kTickGap) * frame.unit;
}

}  // namespace ridgeway
