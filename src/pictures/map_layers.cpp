// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "map_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

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

/// From the 2nd to the 98th percentile, so that a few outliers do not take the colours.
Range middle_range(const std::vector<DiagramDot>& dots) {
  std::vector<double> values;
  for (const DiagramDot& dot : dots)
    if (std::isfinite(dot.value)) values.push_back(dot.value);
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[values.size() / 50], values[values.size() - 1 - values.size() / 50]};
}

std::vector<DiagramDot> diagram_dots(const Roadmap& roadmap, const std::vector<VoxelId>& voxels,
                                     DiagramColour colour) {
  const EsdfMap& esdf = roadmap.esdf;
  std::vector<DiagramDot> dots;
  for (const VoxelId id : voxels) {
    const Point centre = to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
    dots.push_back({centre, colour == DiagramColour::kHeight ? centre.z() : esdf.distance(id)});
  }
  return dots;
}

/// Calls stroke(colour) after the lines, or dots, of each of a few colours: small and fast in SVG
/// too.
template <typename Stroke>
void stroke_by_component(const std::vector<std::size_t>& components, const Stroke& stroke) {
  std::array<std::vector<std::size_t>, kComponentColours> buckets;
  for (std::size_t i = 0; i < components.size(); ++i)
    buckets[components[i] % kComponentColours].push_back(i);
  for (std::size_t colour = 0; colour < kComponentColours; ++colour)
    if (!buckets[colour].empty()) stroke(component_colour(colour), buckets[colour]);
}

}  // namespace

MapMarks marks_of(const Roadmap& roadmap, const PictureConfig& config) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::vector<VoxelId> voxels = roadmap.diagram.voxels.members(esdf.layout);
  MapMarks marks;
  marks.limits = limits_in_world(esdf);
  marks.dots = diagram_dots(roadmap, voxels, config.diagram_colour);
  const bool by_component = config.diagram_colour == DiagramColour::kComponent;
  if (by_component || config.narrow_places) {
    std::vector<VoxelId> asked = voxels;
    for (const Vertex& v : roadmap.graph.vertices) asked.push_back(esdf.layout.find(v.voxel));
    const ComponentReport report = SpaceParts(esdf).report(roadmap.min_clearance, asked);
    for (std::size_t i = 0; by_component && i < voxels.size(); ++i)
      marks.dots[i].value = static_cast<double>(report.asked[i]);
    if (by_component)
      marks.of_vertices.assign(report.asked.begin() + static_cast<std::ptrdiff_t>(voxels.size()),
                               report.asked.end());
    for (const ComponentJoin& join : report.joins)
      if (config.narrow_places && join.radius > 0.5 * esdf.voxel_size) marks.narrow.push_back(join);
  }
  marks.range = middle_range(marks.dots);
  if (!config.diagram) marks.dots.clear();
  return marks;
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

namespace {

/// One stroke for each of 24 colours: small and fast in SVG too.
void draw_diagram(Canvas& canvas, const MapMarks& marks, double voxel_size, const MapFrame& frame) {
  constexpr std::size_t kColours = kComponentColours;
  std::array<std::vector<const DiagramDot*>, kColours> buckets;
  for (const DiagramDot& dot : marks.dots) {
    if (!frame.shows(dot.centre)) continue;
    const double share = std::clamp(marks.range.share(dot.value), 0.0, 0.999);
    const auto bucket = marks.by_component() ? static_cast<std::size_t>(dot.value) % kColours
                                             : static_cast<std::size_t>(share * kColours);
    buckets[bucket].push_back(&dot);
  }
  canvas.set_line(std::clamp(0.75 * voxel_size * frame.scale, 2.2 * frame.unit, 5.0 * frame.unit));
  for (std::size_t i = 0; i < kColours; ++i) {
    for (const DiagramDot* dot : buckets[i])
      add_dot(canvas, frame.x(dot->centre), frame.y(dot->centre));
    canvas.set_colour(marks.by_component() ? component_colour(i)
                                           : ramp_colour((static_cast<double>(i) + 0.5) / kColours),
                      0.6);
    cairo_stroke(canvas.cairo());
  }
}

void draw_graph(Canvas& canvas, const Roadmap& roadmap, const MapMarks& marks,
                const MapFrame& frame) {
  const SparseGraph& graph = roadmap.graph;
  std::vector<Point> places;
  for (const Vertex& v : graph.vertices) places.push_back(to_world(roadmap.esdf, v.position));
  cairo_t* cairo = canvas.cairo();
  const double dot = vertex_size(graph, frame);
  const auto add_edge = [&](const Edge& edge) {
    Point a = places[number(edge.from)], b = places[number(edge.to)];
    if (!frame.clip(a, b)) return;
    cairo_move_to(cairo, frame.x(a), frame.y(a));
    cairo_line_to(cairo, frame.x(b), frame.y(b));
  };
  const auto stroke = [&](const Colour& colour, double width, double opacity) {
    canvas.set_colour(colour, opacity);
    canvas.set_line(width);
    cairo_stroke(cairo);
  };
  const double line = std::min(1.2 * frame.unit, 0.3 * dot);
  if (marks.by_component()) {
    std::vector<std::size_t> of_edges;
    for (const Edge& edge : graph.edges) of_edges.push_back(marks.of_vertices[number(edge.from)]);
    stroke_by_component(of_edges, [&](const Colour& colour, const auto& members) {
      for (const std::size_t i : members) add_edge(graph.edges[i]);
      stroke(colour, line, 0.7);
    });
    stroke_by_component(marks.of_vertices, [&](const Colour& colour, const auto& members) {
      for (const std::size_t i : members)
        if (frame.shows(places[i])) add_dot(canvas, frame.x(places[i]), frame.y(places[i]));
      stroke(colour, dot, 1.0);
    });
    return;
  }
  for (const Edge& edge : graph.edges) add_edge(edge);
  stroke(ink::kGraph, line, 0.7);
  for (const Point& p : places)
    if (frame.shows(p)) add_dot(canvas, frame.x(p), frame.y(p));
  stroke(ink::kGraph, dot, 1.0);
}

}  // namespace

void draw_skeleton(Canvas& canvas, const Roadmap& roadmap, const MapMarks& marks, bool graph,
                   const MapFrame& frame) {
  cairo_t* cairo = canvas.cairo();
  cairo_save(cairo);
  cairo_rectangle(cairo, frame.left, frame.top, frame.width, frame.height);
  cairo_clip(cairo);
  draw_diagram(canvas, marks, roadmap.esdf.voxel_size, frame);
  if (graph) draw_graph(canvas, roadmap, marks, frame);
  cairo_restore(cairo);
}

void draw_limits(Canvas& canvas, const FlightLimits& limits, const MapFrame& frame) {
  if (!limits.any()) return;
  const double right = frame.left + frame.width, bottom = frame.top + frame.height;
  const auto within = [&](const Box& box, const auto& draw) {
    const double x0 = std::clamp(frame.x(box.min), frame.left, right),
                 x1 = std::clamp(frame.x(box.max), frame.left, right),
                 y0 = std::clamp(frame.y(box.max), frame.top, bottom),
                 y1 = std::clamp(frame.y(box.min), frame.top, bottom);
    if (x1 > x0 && y1 > y0) draw(x0, y0, x1 - x0, y1 - y0);
  };
  const int along = frame.projection.along;
  for (const Box& box : limits.keep_out)
    if (box.max[along] >= frame.range.low && box.min[along] <= frame.range.high)
      within(box, [&](double x, double y, double width, double height) {
        draw_no_fly(canvas, x, y, width, height, frame.unit);
      });
  within(limits.keep_in, [&](double x, double y, double width, double height) {
    if (width >= frame.width && height >= frame.height) return;  // no limit within the map
    stroke_keep_in(canvas, x, y, width, height, frame.unit);
  });
}

void draw_narrow_places(Canvas& canvas, const MapMarks& marks, const MapFrame& frame) {
  constexpr double kWide = 58.0, kHigh = 22.0;  // of a text, units
  const double u = frame.unit;
  for (const ComponentJoin& join : marks.narrow)
    if (frame.shows(join.place))
      draw_narrow(canvas, frame.x(join.place), frame.y(join.place),
                  std::max(join.radius * frame.scale, 5.0 * u), u);
  std::vector<std::pair<double, double>> texts;
  for (const ComponentJoin& join : marks.narrow) {
    const double x = frame.x(join.place), y = frame.y(join.place);
    // Where texts would cover each other, that of the widest is read.
    const bool is_covered = std::any_of(texts.begin(), texts.end(), [&](const auto& text) {
      return std::abs(text.first - x) < kWide * u && std::abs(text.second - y) < kHigh * u;
    });
    if (is_covered || !frame.shows(join.place)) continue;
    texts.emplace_back(x, y);
    const std::string label = short_number_at_most(join.radius, 2) + " m";
    canvas.set_font(14.0 * u, true);
    // Above its ring, but not over what is written above the map.
    const double width = canvas.text_width(label);
    const double top = y - 30.0 * u < frame.top ? y + 12.0 * u : y - 30.0 * u;
    canvas.fill_rectangle(x - 0.5 * width - 3.0 * u, top, width + 6.0 * u, 18.0 * u, ink::kHalo);
    canvas.set_colour(ink::kNarrow);
    canvas.draw_text(x, top + 14.0 * u, label, Canvas::Align::kMiddle);
  }
}

}  // namespace ridgeway
