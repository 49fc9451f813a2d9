// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>

#include "map_layers.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {

void draw_map_sheet(std::span<const SheetMap> maps, int columns, const std::string& title,
                    const std::filesystem::path& out, const PictureConfig& config) {
  config.validate();
  check_picture_extension(out);
  if (maps.empty() || columns < 1)
    throw InputError("sheet", "has no maps or no columns", "give at least one of each");
  const double u = config.width / 1600.0, gap = 24.0 * u, caption = 34.0 * u, head = 84.0 * u;
  const double cell = (config.width - (columns + 1) * gap) / columns;
  std::vector<FloorRaster> rasters;
  double widest = 0.0, highest = 0.0;  // metres
  for (const SheetMap& map : maps) {
    const EsdfMap& esdf = map.roadmap->esdf;
    rasters.push_back(make_floor_raster(esdf, kFromAbove, config.band, static_cast<int>(cell)));
    widest = std::max(widest, rasters.back().width(esdf.voxel_size));
    highest = std::max(highest, rasters.back().height(esdf.voxel_size));
  }
  const double scale = cell / widest, row = highest * scale + caption + gap;
  const auto rows =
      (maps.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  Canvas canvas(out, config.width,
                static_cast<int>(std::ceil(head + static_cast<double>(rows) * row)));
  canvas.set_colour(ink::kText);
  canvas.set_font(28.0 * u, true);
  canvas.draw_text(gap, 46.0 * u, canvas.fitted(title, config.width - 2.0 * gap));
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Roadmap& roadmap = *maps[i].roadmap;
    const double s = roadmap.esdf.voxel_size;
    const std::size_t across = static_cast<std::size_t>(columns);
    const auto column = static_cast<double>(i % across),
               line = std::floor(static_cast<double>(i) / columns);
    MapFrame frame;
    frame.left = gap + column * (cell + gap);
    frame.top = head + line * row + caption;
    frame.scale = scale;
    frame.width = rasters[i].width(s) * scale;
    frame.height = rasters[i].height(s) * scale;
    frame.min = rasters[i].min_corner(s);
    frame.unit = 0.7 * u;
    draw_raster(canvas, rasters[i], frame);
    const MapMarks marks = marks_of(roadmap, config);
    draw_skeleton(canvas, roadmap, marks, config.graph, frame);
    canvas.set_colour(ink::kText);
    canvas.set_font(17.0 * u);
    canvas.draw_text(frame.left, frame.top - 10.0 * u, canvas.fitted(maps[i].caption, cell));
  }
  canvas.finish();
}

}  // namespace ridgeway
