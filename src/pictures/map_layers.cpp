// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "map_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ridgeway {
namespace {

Colour blend(const Colour& a, const Colour& b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

Colour cell_colour(const FloorRaster::Cell& cell) {
  if (cell.free + cell.occupied == 0) return ink::kUnknown;
  if (cell.occupied == 0) return ink::kFree;
  const double share = static_cast<double>(cell.occupied) / (cell.free + cell.occupied);
  return blend(ink::kFree, ink::kWall, 0.12 + 0.88 * std::pow(share, 0.7));
}

void add_dot(Canvas& canvas, double x, double y) {
  cairo_move_to(canvas.cairo(), x, y);
  cairo_line_to(canvas.cairo(), x, y);
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

}  // namespace

std::vector<DiagramDot> diagram_dots(const Roadmap& roadmap, DiagramColour colour) {
  std::vector<DiagramDot> dots;
  const EsdfMap& esdf = roadmap.esdf;
  for (const VoxelId id : roadmap.diagram.voxels.members(esdf.layout)) {
    const Point centre = to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
    const bool height = colour == DiagramColour::kHeight;
    dots.push_back({centre, height ? centre.z() : roadmap.esdf.distance(id)});
  }
  return dots;
}

Range middle_range(const std::vector<DiagramDot>& dots) {
  std::vector<double> values;
  for (const DiagramDot& dot : dots)
    if (std::isfinite(dot.value)) values.push_back(dot.value);
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[values.size() / 50], values[values.size() - 1 - values.size() / 50]};
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

void draw_graph(Canvas& canvas, const Roadmap& roadmap, const MapFrame& frame) {
  const SparseGraph& graph = roadmap.graph;
  std::vector<Point> places;
  for (const Vertex& v : graph.vertices) places.push_back(to_world(roadmap.esdf, v.position));
  cairo_t* cairo = canvas.cairo();
  const double dot = vertex_size(graph, frame);
  for (const Edge& edge : graph.edges) {
    const Point &a = places[number(edge.from)], &b = places[number(edge.to)];
    cairo_move_to(cairo, frame.x(a), frame.y(a));
    cairo_line_to(cairo, frame.x(b), frame.y(b));
  }
  canvas.set_colour(ink::kGraph, 0.7);
  canvas.set_line(std::min(1.2 * frame.unit, 0.3 * dot));
  cairo_stroke(cairo);
  for (const Point& p : places) add_dot(canvas, frame.x(p), frame.y(p));
  canvas.set_line(dot);
  canvas.set_colour(ink::kGraph);
  cairo_stroke(cairo);
}

}  // namespace ridgeway
