// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/pictures/picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "canvas.hpp"
#include "chart.hpp"
#include "map_layers.hpp"
#include "panels.hpp"
#include "picture_frame.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway {
namespace {

/// What a frame shows of a path, in one line for as long as it does not leave it.
void trace(Canvas& canvas, std::span<const Point> path, const MapFrame& frame) {
  std::optional<Point> last;
  for (std::size_t i = 0; i < path.size(); ++i) {
    Point a = path[i], b = path[std::min(i + 1, path.size() - 1)];
    if (!frame.clip(a, b)) continue;
    if (!last || *last != a) cairo_move_to(canvas.cairo(), frame.x(a), frame.y(a));
    cairo_line_to(canvas.cairo(), frame.x(b), frame.y(b));
    last = b;
  }
}

/// A path as it is drawn.
struct PathLayer {
  std::span<const Point> waypoints;
  std::string label;
  PathStroke stroke;
  bool halo = false;        ///< stands out from what is below
  std::string ending = {};  ///< of the label: how long the path is
};

/// Those that there are, the uppermost last: the legend names them from there on, those to compare
/// in the order in which they were given.
std::vector<PathLayer> path_layers(std::span<const Point> path, const PictureConfig& config) {
  std::vector<PathLayer> layers;
  const auto add = [&](PathLayer layer) {
    if (!layer.waypoints.empty()) layers.push_back(std::move(layer));
  };
  add({config.raw_path, config.raw_path_label, {ink::kRawPath, 2.5, {7.0, 5.0}}});
  for (std::size_t i = config.paths.size(); i-- > 0;) {
    const NamedPath& other = config.paths[i];
    PathStroke stroke{kSeriesColours[i], 4.0, {}};
    if (i % 2 == 1) stroke.dashes = {10.0, 9.0};  // neighbours differ by more than their colour
    add({other.waypoints, other.name, std::move(stroke), false,
         ", " + short_number(length_of(other.waypoints), 1) + " m"});
  }
  add({path, config.path_label, {ink::kPath, 5.0, {}}, true});
  return layers;
}

/// Whether a place lies in the part of the page that a frame shows.
bool is_within(const MapFrame& frame, const Point& p) {
  const double x = frame.x(p) - frame.left, y = frame.y(p) - frame.top;
  return x >= 0.0 && x <= frame.width && y >= 0.0 && y <= frame.height;
}

void draw_paths(Canvas& canvas, const std::vector<PathLayer>& layers, const MapFrame& frame) {
  const double u = frame.unit;
  cairo_save(canvas.cairo());
  cairo_rectangle(canvas.cairo(), frame.left, frame.top, frame.width, frame.height);
  cairo_clip(canvas.cairo());
  for (const PathLayer& layer : layers) {
    trace(canvas, layer.waypoints, frame);
    if (layer.halo) {
      canvas.set_line((layer.stroke.width + 4.0) * u);
      canvas.set_colour(ink::kHalo, 0.85);
      cairo_stroke_preserve(canvas.cairo());
    }
    set_stroke(canvas, layer.stroke, u);
    cairo_stroke(canvas.cairo());
  }
  cairo_restore(canvas.cairo());
}

/// The paths whose ends are marked.
std::vector<std::span<const Point>> marked_paths(std::span<const Point> path,
                                                 const PictureConfig& config) {
  std::vector<std::span<const Point>> marked;
  for (const NamedPath& other : config.paths)
    if (!other.waypoints.empty()) marked.emplace_back(other.waypoints);
  if (!path.empty()) marked.push_back(path);
  return marked;
}

/// Starts over goals: the disc leaves the star to be seen where a path ends at its start.
void draw_ends(Canvas& canvas, const std::vector<std::span<const Point>>& paths,
               const MapFrame& frame) {
  const auto draw = [&](const Point& place, const auto& mark) {
    if (frame.shows(place) && is_within(frame, place))
      mark(canvas, frame.x(place), frame.y(place), frame.unit);
  };
  for (const std::span<const Point> path : paths) draw(path.back(), draw_goal);
  for (const std::span<const Point> path : paths) draw(path.front(), draw_start);
}

/// Whether no panel cuts a path.
bool is_drawn_whole(std::span<const Point> path, const std::vector<Panel>& panels) {
  return std::all_of(path.begin(), path.end(), [&](const Point& p) {
    return std::all_of(panels.begin(), panels.end(),
                       [&](const Panel& panel) { return is_within(panel.frame, p); });
  });
}

std::string title_of(const Roadmap& roadmap, const PictureConfig& config) {
  if (!config.title.empty()) return config.title;
  const std::string name = std::filesystem::path(roadmap.source).filename().string();
  return name.empty() ? "Map" : name;
}

std::string subtitle_of(const Roadmap& roadmap, std::span<const Point> path,
                        const std::vector<Panel>& panels, const PictureConfig& config) {
  const std::string gap = "  \u00b7  ";
  std::string text = "voxels of " + short_number(roadmap.esdf.voxel_size, 4) + " m" + gap +
                     grouped(roadmap.graph.vertices.size()) + " vertices, " +
                     grouped(roadmap.graph.edges.size()) + " edges";
  if (!path.empty())
    text += gap + config.path_label + " of " + short_number(length_of(path), 2) + " m" +
            (is_drawn_whole(path, panels) ? "" : ", part of it outside of the map");
  if (panels.size() > 1) return text;  // their captions tell
  return text + gap + heights_text(roadmap.esdf, panels.front().raster);
}

/// Whether a panel shows an edge of the box that flights stay within.
bool is_cut(const Box& keep_in, const FloorRaster& raster, double voxel_size) {
  const Point low = raster.min_corner(voxel_size);
  const auto [across, up, along] = raster.projection;
  if (keep_in.min[up] >= keep_in.max[up]) return false;  // the plane of a planar map
  return keep_in.min[across] > low[across] || keep_in.min[up] > low[up] ||
         keep_in.max[across] < low[across] + raster.width(voxel_size) ||
         keep_in.max[up] < low[up] + raster.height(voxel_size);
}

/// So many that a number has two digits that count.
int decimals_of(double value) {
  constexpr int kMost = 6;
  if (!(value > 0.0)) return 1;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(value))), 1, kMost);
}

std::string diagram_text(const Range& range, const PictureConfig& config) {
  if (config.diagram_colour == DiagramColour::kComponent)
    return "diagram and graph, a colour for each connected component";
  const bool height = config.diagram_colour == DiagramColour::kHeight;
  const int decimals = decimals_of(height ? range.high - range.low : range.low);
  return std::string("diagram, ") + (height ? "height " : "clearance ") +
         short_number(range.low, decimals) + " to " + short_number(range.high, decimals) + " m";
}

std::vector<LegendItem> legend_items(const MapMarks& marks, const std::vector<PathLayer>& layers,
                                     bool ends, bool keep_in, bool planar,
                                     const PictureConfig& config) {
  using Mark = LegendItem::Mark;
  std::vector<LegendItem> items = {
      {Mark::kFree, "free"},
      {Mark::kWall, planar ? "occupied" : "occupied, paler at few heights"},
      {Mark::kUnknown, "unknown"}};
  if (config.graph && !marks.by_component()) items.push_back({Mark::kGraph, "graph"});
  if (!marks.dots.empty() || marks.by_component())
    items.push_back({marks.by_component() ? Mark::kComponents : Mark::kDiagram,
                     diagram_text(marks.range, config)});
  if (!marks.limits.keep_out.empty()) items.push_back({Mark::kNoFly, "no flights"});
  if (keep_in) items.push_back({Mark::kKeepIn, "flights stay within"});
  if (!marks.narrow.empty()) items.push_back({Mark::kNarrow, "narrow: the radius that fits"});
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
    items.push_back({Mark::kPath, layer->label, layer->stroke, layer->ending});
  if (ends) {
    items.push_back({Mark::kStart, "start"});
    items.push_back({Mark::kGoal, "goal"});
  }
  return items;
}

/// The page: title above, maps, then scale bar and legend side by side.
struct Page {
  LegendLayout legend;
  double unit = 1.0;
  double left = 0.0;  ///< of the maps: as much as is written beside them
  double legend_left = 0.0, legend_top = 0.0, charts_top = 0.0;
  int height = 0;
};

constexpr double kMargin = 36.0, kLeft = 78.0, kTitle = 96.0, kScaleBar = 300.0;
constexpr double kEdgeGap = 4.0;  // between the page's edge and what is written beside the maps

/// `measure`: of the picture's own format, in which texts are as wide as they will be.
Page lay_out_page(Canvas& measure, std::vector<Panel>& panels, double voxel_size,
                  std::span<const LegendItem> items, const PictureConfig& config) {
  Page page;
  page.unit = config.width / 1600.0;
  const double u = page.unit;
  page.left = kLeft * u;
  const auto lay_out_maps = [&] {
    return lay_out_panels(panels, voxel_size, page.left, kTitle * u,
                          config.width - page.left - kMargin * u, u);
  };
  lay_out_maps();  // which coordinates are written depends on the scale
  for (const Panel& panel : panels)
    page.left = std::max(page.left, border_width(measure, panel.frame) + kEdgeGap * u);
  page.legend_top = lay_out_maps();
  page.legend_left = page.left + kScaleBar * u;
  page.legend = lay_out_legend(measure, items, config.width - page.legend_left - kMargin * u, u);
  const double rows = std::max(1.6, static_cast<double>(page.legend.rows.size()));
  page.charts_top = page.legend_top + (rows + 0.2) * legend_row_height(u);
  page.height =
      static_cast<int>(std::ceil(page.legend_top + rows * legend_row_height(u) +
                                 charts_height(config.charts.size(), u) + 0.5 * kMargin * u));
  return page;
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle,
                const PictureConfig& config, const Page& page) {
  const double unit = page.unit;
  const double room = config.width - page.left - kMargin * unit;
  canvas.set_colour(ink::kText);
  canvas.set_font(28.0 * unit, true);
  canvas.draw_text(page.left, 46.0 * unit, canvas.fitted(title, room));
  canvas.set_colour(ink::kFaint);
  canvas.set_font(17.0 * unit);
  canvas.draw_text(page.left, 76.0 * unit, canvas.fitted(subtitle, room));
}

void draw_caption(Canvas& canvas, const Panel& panel) {
  if (panel.caption.empty()) return;
  const MapFrame& frame = panel.frame;
  canvas.set_colour(ink::kText);
  canvas.set_font(18.0 * frame.unit, true);
  canvas.draw_text(frame.left, frame.top - 12.0 * frame.unit, panel.caption);
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
  if (paths.size() > kSeriesColours.size()) {
    throw InputError("paths", "are " + std::to_string(paths.size()),
                     "draw at most eight into one picture");
  }
  for (const auto& [name, cut] : {std::pair{"section_x", section_x}, {"section_y", section_y}})
    if (cut && !std::isfinite(*cut))
      throw InputError(name, "is no coordinate", "give metres in the map's frame");
  validate_charts(charts);
}

void draw_floor_plan(const Roadmap& roadmap, std::span<const Point> path,
                     const std::filesystem::path& out, const PictureConfig& config) {
  config.validate();
  check_picture_extension(out);
  const double voxel_size = roadmap.esdf.voxel_size;
  std::vector<Panel> panels = make_panels(roadmap, config);
  const MapMarks marks = marks_of(roadmap, config);
  const std::vector<PathLayer> layers = path_layers(path, config);
  const std::vector<std::span<const Point>> marked = marked_paths(path, config);
  const bool keep_in = std::any_of(panels.begin(), panels.end(), [&](const Panel& panel) {
    return is_cut(marks.limits.keep_in, panel.raster, voxel_size);
  });
  const std::vector<LegendItem> items =
      legend_items(marks, layers, !marked.empty(), keep_in, roadmap.esdf.planar, config);
  Canvas measure(out, 8, 8);  // is not written
  const Page page = lay_out_page(measure, panels, voxel_size, items, config);
  const double u = page.unit;

  Canvas canvas(out, config.width, page.height);
  for (const Panel& panel : panels) {
    const MapFrame& frame = panel.frame;
    draw_raster(canvas, panel.raster, frame);
    draw_limits(canvas, marks.limits, frame);
    draw_skeleton(canvas, roadmap, marks, config.graph, frame);
    draw_border(canvas, frame);
    draw_paths(canvas, layers, frame);
    draw_narrow_places(canvas, marks, frame);
    draw_ends(canvas, marked, frame);
    draw_caption(canvas, panel);
  }
  draw_title(canvas, title_of(roadmap, config), subtitle_of(roadmap, path, panels, config), config,
             page);
  draw_scale_bar(canvas, panels.front().frame, page.left, page.legend_top, (kScaleBar - 80.0) * u);
  draw_legend(canvas, items, page.legend, page.legend_left, page.legend_top, u);
  draw_charts(canvas, config.charts, page.left, page.charts_top,
              config.width - page.left - kMargin * u, u);
  canvas.finish();
}

}  // namespace ridgeway
