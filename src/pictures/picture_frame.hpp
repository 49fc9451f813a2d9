// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "canvas.hpp"
#include "floor_raster.hpp"

namespace ridgeway {

/// Colours of the floor plan, in one place.
namespace ink {
inline constexpr Colour kUnknown{0.910, 0.922, 0.933};
inline constexpr Colour kFree{1.0, 1.0, 1.0};
inline constexpr Colour kWall{0.16, 0.18, 0.21};
inline constexpr Colour kText{0.13, 0.15, 0.18};
inline constexpr Colour kFaint{0.42, 0.45, 0.49};
inline constexpr Colour kFrame{0.62, 0.65, 0.69};
inline constexpr Colour kGraph{0.16, 0.36, 0.58};
inline constexpr Colour kPath{0.84, 0.15, 0.16};
inline constexpr Colour kRawPath{0.91, 0.49, 0.18};
inline constexpr Colour kStart{0.10, 0.55, 0.27};
inline constexpr Colour kHalo{1.0, 1.0, 1.0};
inline constexpr Colour kNoFly{0.66, 0.10, 0.52};
inline constexpr Colour kNarrow{0.76, 0.33, 0.02};
}  // namespace ink

/// Where the map lies on the page, pixels, and from where it is seen. Points are in the world.
struct MapFrame {
  Projection projection;
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double scale = 1.0;         ///< pixels a metre
  Point min = Point::Zero();  ///< map corner at the frame's left and bottom
  /// What of graph, diagram and paths is drawn: between these coordinates along the line of sight.
  HeightBand range{-std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  double unit = 1.0;  ///< a pixel on a page of 1600

  double x(const Point& p) const {
    return left + (p[projection.across] - min[projection.across]) * scale;
  }
  double y(const Point& p) const {
    return top + height - (p[projection.up] - min[projection.up]) * scale;
  }
  bool shows(const Point& p) const {
    return p[projection.along] >= range.low && p[projection.along] <= range.high;
  }
  /// The piece of a segment that is shown; false where none is.
  bool clip(Point& a, Point& b) const;
};

/// A box that nobody may fly through: hatched, so that it is no wall.
void draw_no_fly(Canvas& canvas, double x, double y, double width, double height, double unit);

/// Strokes the edge of the box that flights have to stay in: dashed.
void stroke_keep_in(Canvas& canvas, double x, double y, double width, double height, double unit);

/// Where it is narrow: a ring.
void draw_narrow(Canvas& canvas, double x, double y, double radius, double unit);

/// Start of a path: a disc. Goal: a star. Both with a white rim.
void draw_start(Canvas& canvas, double x, double y, double unit);
void draw_goal(Canvas& canvas, double x, double y, double unit);

/// How a path is drawn; lengths in units.
struct PathStroke {
  Colour colour;
  double width = 0.0;
  std::vector<double> dashes;  ///< lengths drawn and left out; empty: solid
};
void set_stroke(Canvas& canvas, const PathStroke& stroke, double unit);

/// An entry of the legend: what is drawn and what it means.
struct LegendItem {
  enum class Mark {
    kFree,
    kWall,
    kUnknown,
    kDiagram,
    kComponents,
    kGraph,
    kPath,
    kStart,
    kGoal,
    kNoFly,
    kKeepIn,
    kNarrow
  };
  Mark mark;
  std::string text;
  PathStroke stroke = {};   ///< of a path
  std::string ending = {};  ///< of the text: stays whole where the rest is shortened
};

/// Rows that the legend takes beside the scale bar.
struct LegendLayout {
  std::vector<std::vector<std::size_t>> rows;  ///< numbers of the items
  std::vector<double> offsets;                 ///< of each item from the legend's left, pixels
  std::vector<std::string> texts;              ///< of each item, no wider than there is room
};
LegendLayout lay_out_legend(Canvas& canvas, std::span<const LegendItem> items, double width,
                            double unit);
inline double legend_row_height(double unit) { return 32.0 * unit; }

void draw_legend(Canvas& canvas, std::span<const LegendItem> items, const LegendLayout& layout,
                 double left, double top, double unit);
/// A bar of a round number of metres, at most a number of pixels long.
void draw_scale_bar(Canvas& canvas, const MapFrame& frame, double left, double top,
                    double most_pixels);
/// Border of the map with coordinates every round number of metres.
void draw_border(Canvas& canvas, const MapFrame& frame);
/// How far the coordinates beside a map reach to the left of it, pixels.
double border_width(Canvas& canvas, const MapFrame& frame);

/// 1, 2 or 5 times a power of ten, the largest that is at most `most`.
double round_step(double most);
/// 12345 as "12,345".
std::string grouped(std::size_t count);
/// A number with no more decimals than it needs, at most `decimals`.
std::string short_number(double value, int decimals);
/// The same, rounded down: a radius that still fits.
std::string short_number_at_most(double value, int decimals);

}  // namespace ridgeway
