// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/io/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "canvas.hpp"
#include "chart.hpp"
#include "floor_raster.hpp"
#include "picture_frame.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

/// Values at the ends of the diagram's colour ramp.
struct Range {
  double low = 0.0;
  double high = 0.0;
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

/// A diagram voxel with the value that gives its colour.
struct DiagramDot {
  Point centre;
  double value = 0.0;
};

std::vector<DiagramDot> diagram_dots(const Roadmap& roadmap, DiagramColour colour) {
  std::vector<DiagramDot> dots;
  for (const VoxelId id : roadmap.diagram.voxels.members()) {
    const Point centre = centre_of(roadmap.esdf.layout.index_of(id), roadmap.esdf.voxel_size);
    const bool height = colour == DiagramColour::kHeight;
    dots.push_back({centre, height ? centre.z() : roadmap.esdf.distance(id)});
  }
  return dots;
}

/// From the 2nd to the 98th percentile, so that a few outliers do not take the colours.
Range middle_range(const std::vector<DiagramDot>& dots) {
  std::vector<double> values;
  for (const DiagramDot& dot : dots)
    if (std::isfinite(dot.value)) values.push_back(dot.value);
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[values.size() / 50], values[values.size() - 1 - values.size() / 50]};
}

Colour blend(const Colour& a, const Colour& b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

Colour cell_colour(const FloorRaster::Cell& cell) {
  if (cell.free + cell.occupied == 0) return ink::kUnknown;
  if (cell.occupied == 0) return ink::kFree;
  const double share = static_cast<double>(cell.occupied) / (cell.free + cell.occupied);
  return blend(ink::kFree, ink::kWall, 0.12 + 0.88 * std::pow(share, 0.7));
}

void draw_raster(Canvas& canvas, const FloorRaster& raster, const MapFrame& frame) {
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, raster.nx, raster.ny), &cairo_surface_destroy);
  unsigned char* pixels = cairo_image_surface_get_data(image.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image.get()));
  const auto nx = static_cast<std::size_t>(raster.nx), ny = static_cast<std::size_t>(raster.ny);
  for (std::size_t y = 0; y < ny; ++y) {
    for (std::size_t x = 0; x < nx; ++x) {
      const auto rgb = bytes_of(cell_colour(raster.cells[(ny - 1 - y) * nx + x]));
      unsigned char* pixel = pixels + y * stride + 4 * x;  // blue first on little-endian machines
      for (std::size_t part = 0; part < 3; ++part) pixel[part] = rgb[2 - part];
    }
  }
  cairo_surface_mark_dirty(image.get());

  cairo_t* cairo = canvas.cairo();
  const double across = frame.width / raster.nx, down = frame.height / raster.ny;
  cairo_save(cairo);
  cairo_rectangle(cairo, frame.left, frame.top, frame.width, frame.height);
  cairo_translate(cairo, frame.left, frame.top);
  cairo_scale(cairo, across, down);
  cairo_set_source_surface(cairo, image.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo),
                           across >= 1.0 ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_fill(cairo);
  cairo_restore(cairo);
}

void add_dot(Canvas& canvas, double x, double y) {
  cairo_move_to(canvas.cairo(), x, y);
  cairo_line_to(canvas.cairo(), x, y);
}

/// One stroke for each of 24 colours: small and fast in SVG too.
void draw_diagram(Canvas& canvas, const std::vector<DiagramDot>& dots, const Range& range,
                  double voxel_size, const MapFrame& frame) {
  constexpr int kColours = 24;
  std::array<std::vector<const DiagramDot*>, kColours> buckets;
  for (const DiagramDot& dot : dots) {
    const double share = std::clamp(range.share(dot.value), 0.0, 0.999);
    buckets[static_cast<std::size_t>(share * kColours)].push_back(&dot);
  }
  canvas.set_line(std::clamp(0.75 * voxel_size * frame.scale, 2.2 * frame.unit, 5.0 * frame.unit));
  for (std::size_t i = 0; i < kColours; ++i) {
    for (const DiagramDot* dot : buckets[i]) {
      add_dot(canvas, frame.x(dot->centre), frame.y(dot->centre));
    }
    canvas.set_colour(ramp_colour((static_cast<double>(i) + 0.5) / kColours), 0.6);
    cairo_stroke(canvas.cairo());
  }
}

/// Smaller dots where vertices stand closer, so that the diagram shows between them.
double vertex_size(const SparseGraph& graph, const MapFrame& frame) {
  std::vector<double> lengths;
  for (const Edge& edge : graph.edges) lengths.push_back(edge.length);
  if (lengths.empty()) return 5.0 * frame.unit;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::clamp(0.2 * *middle * frame.scale, 1.4 * frame.unit, 6.0 * frame.unit);
}

void draw_graph(Canvas& canvas, const SparseGraph& graph, const MapFrame& frame) {
  cairo_t* cairo = canvas.cairo();
  const double dot = vertex_size(graph, frame);
  for (const Edge& edge : graph.edges) {
    const Point& a = graph.vertices[number(edge.from)].position;
    const Point& b = graph.vertices[number(edge.to)].position;
    cairo_move_to(cairo, frame.x(a), frame.y(a));
    cairo_line_to(cairo, frame.x(b), frame.y(b));
  }
  canvas.set_colour(ink::kGraph, 0.7);
  canvas.set_line(std::min(1.2 * frame.unit, 0.3 * dot));
  cairo_stroke(cairo);
  for (const Vertex& v : graph.vertices) add_dot(canvas, frame.x(v.position), frame.y(v.position));
  canvas.set_line(dot);
  canvas.set_colour(ink::kGraph);
  cairo_stroke(cairo);
}

void trace(Canvas& canvas, std::span<const Point> path, const MapFrame& frame) {
  for (const Point& p : path) cairo_line_to(canvas.cairo(), frame.x(p), frame.y(p));
}

void draw_paths(Canvas& canvas, std::span<const Point> path, std::span<const Point> raw,
                const MapFrame& frame) {
  const double u = frame.unit;
  trace(canvas, raw, frame);
  canvas.set_line(2.5 * u, {7.0 * u, 5.0 * u});
  canvas.set_colour(ink::kRawPath);
  cairo_stroke(canvas.cairo());
  trace(canvas, path, frame);
  canvas.set_line(9.0 * u);
  canvas.set_colour(ink::kHalo, 0.85);
  cairo_stroke_preserve(canvas.cairo());
  canvas.set_line(5.0 * u);
  canvas.set_colour(ink::kPath);
  cairo_stroke(canvas.cairo());
  if (path.empty()) return;
  draw_start(canvas, frame.x(path.front()), frame.y(path.front()), u);
  draw_goal(canvas, frame.x(path.back()), frame.y(path.back()), u);
}

double length_of(std::span<const Point> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::string title_of(const Roadmap& roadmap, const PictureConfig& config) {
  if (!config.title.empty()) return config.title;
  const std::string name = std::filesystem::path(roadmap.source).filename().string();
  return name.empty() ? "Map" : name;
}

std::string subtitle_of(const Roadmap& roadmap, std::span<const Point> path,
                        const FloorRaster& raster) {
  const std::string gap = "  \u00b7  ";
  std::string text = "voxels of " + short_number(roadmap.esdf.voxel_size, 4) + " m" + gap +
                     grouped(roadmap.graph.vertices.size()) + " vertices, " +
                     grouped(roadmap.graph.edges.size()) + " edges";
  if (!path.empty()) text += gap + "path of " + short_number(length_of(path), 2) + " m";
  return text + gap + "walls at heights " + short_number(raster.band.low, 2) + " to " +
         short_number(raster.band.high, 2) + " m";
}

std::vector<LegendItem> legend_items(bool diagram, const Range& range, std::span<const Point> path,
                                     const PictureConfig& config) {
  using Mark = LegendItem::Mark;
  std::vector<LegendItem> items = {
      {Mark::kFree, "free"}, {Mark::kWall, "occupied"}, {Mark::kUnknown, "unknown"}};
  if (config.graph) items.push_back({Mark::kGraph, "graph"});
  if (diagram) {
    const bool height = config.diagram_colour == DiagramColour::kHeight;
    items.push_back({Mark::kDiagram,
                     std::string("diagram, ") + (height ? "height " : "clearance ") +
                         short_number(range.low, 1) + " to " + short_number(range.high, 1) + " m"});
  }
  if (!path.empty()) items.push_back({Mark::kPath, config.path_label});
  if (!config.raw_path.empty()) items.push_back({Mark::kRawPath, config.raw_path_label});
  if (!path.empty()) {
    items.push_back({Mark::kStart, "start"});
    items.push_back({Mark::kGoal, "goal"});
  }
  return items;
}

/// The page: title above, map, then scale bar and legend side by side.
struct Page {
  MapFrame frame;
  LegendLayout legend;
  double legend_left = 0.0, legend_top = 0.0, charts_top = 0.0;
  int height = 0;
};

constexpr double kMargin = 36.0, kLeft = 78.0, kTitle = 96.0, kAxis = 46.0, kScaleBar = 300.0;

Page lay_out_page(const FloorRaster& raster, double voxel_size, std::span<const LegendItem> items,
                  const PictureConfig& config) {
  Page page;
  MapFrame& frame = page.frame;
  frame.unit = config.width / 1600.0;
  const double u = frame.unit;
  const double across = raster.width(voxel_size), down = raster.height(voxel_size);
  const double room = config.width - (kLeft + kMargin) * u;
  frame.scale = std::min(room / across, 1.2 * config.width / down);
  frame.width = across * frame.scale;
  frame.height = std::max(down * frame.scale, u);
  frame.left = kLeft * u + 0.5 * (room - frame.width);
  frame.top = kTitle * u;
  frame.min = raster.min_corner(voxel_size);

  Canvas measure("page.svg", 8, 8);
  page.legend_left = (kLeft + kScaleBar) * u;
  page.legend = lay_out_legend(measure, items, config.width - page.legend_left - kMargin * u, u);
  page.legend_top = frame.top + frame.height + kAxis * u;
  const double rows = std::max(1.6, static_cast<double>(page.legend.rows.size()));
  page.charts_top = page.legend_top + (rows + 0.2) * legend_row_height(u);
  page.height =
      static_cast<int>(std::ceil(page.legend_top + rows * legend_row_height(u) +
                                 charts_height(config.charts.size(), u) + 0.5 * kMargin * u));
  return page;
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle,
                const PictureConfig& config, double unit) {
  const double room = config.width - (kLeft + kMargin) * unit;
  canvas.set_colour(ink::kText);
  canvas.set_font(28.0 * unit, true);
  canvas.draw_text(kLeft * unit, 46.0 * unit, canvas.fitted(title, room));
  canvas.set_colour(ink::kFaint);
  canvas.set_font(17.0 * unit);
  canvas.draw_text(kLeft * unit, 76.0 * unit, canvas.fitted(subtitle, room));
}

}  // namespace

void PictureConfig::validate() const {
  if (width < 400 || width > 16000) {
    throw InputError("width", std::to_string(width) + " is outside 400 to 16000",
                     "give the picture's width in pixels");
  }
  if (band && !(band->low <= band->high)) {
    throw InputError("band", "is empty", "give the lower height first");
  }
  validate_charts(charts);
}

void draw_floor_plan(const Roadmap& roadmap, std::span<const Point> path,
                     const std::filesystem::path& out, const PictureConfig& config) {
  config.validate();
  check_picture_extension(out);
  const double voxel_size = roadmap.esdf.voxel_size;
  const FloorRaster raster = make_floor_raster(roadmap.esdf, config.band, config.width);
  std::vector<DiagramDot> dots;
  if (config.diagram) dots = diagram_dots(roadmap, config.diagram_colour);
  const Range range = middle_range(dots);
  const std::vector<LegendItem> items = legend_items(!dots.empty(), range, path, config);
  const Page page = lay_out_page(raster, voxel_size, items, config);
  const MapFrame& frame = page.frame;

  Canvas canvas(out, config.width, page.height);
  draw_raster(canvas, raster, frame);
  draw_diagram(canvas, dots, range, voxel_size, frame);
  if (config.graph) draw_graph(canvas, roadmap.graph, frame);
  draw_border(canvas, frame);
  draw_paths(canvas, path, config.raw_path, frame);
  draw_title(canvas, title_of(roadmap, config), subtitle_of(roadmap, path, raster), config,
             frame.unit);
  draw_scale_bar(canvas, frame, kLeft * frame.unit, page.legend_top,
                 (kScaleBar - 80.0) * frame.unit);
  draw_legend(canvas, items, page.legend, page.legend_left, page.legend_top, frame.unit);
  draw_charts(canvas, config.charts, kLeft * frame.unit, page.charts_top,
              config.width - (kLeft + kMargin) * frame.unit, frame.unit);
  canvas.finish();
}

}  // namespace ridgeway
