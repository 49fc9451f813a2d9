// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "panels.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr HeightBand kAll{-kInfinite, kInfinite};
constexpr double kPanelCaption = 40.0, kPanelAxis = 46.0;  // heights, units

std::string between(const HeightBand& band) {
  return short_number(band.low, 2) + " to " + short_number(band.high, 2) + " m";
}

}  // namespace

std::string heights_text(const EsdfMap& esdf, const FloorRaster& raster) {
  if (!esdf.planar) return "walls at heights " + between(raster.band);
  const double low = raster.first.z * esdf.voxel_size;
  return "the plane's voxels at heights " + between({low, low + esdf.voxel_size});
}

namespace {

void add_plans(const Roadmap& roadmap, const PictureConfig& config, std::vector<Panel>& panels) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::vector<Storey> storeys =
      config.floors ? find_storeys(esdf, 2.0 * roadmap.min_clearance) : std::vector<Storey>{};
  if (storeys.size() < 2) {
    Panel plan{make_floor_raster(esdf, kFromAbove, config.band, config.width), kAll, {}, {}};
    plan.caption = "From above, " + heights_text(esdf, plan.raster);
    panels.push_back(std::move(plan));
    return;
  }
  for (std::size_t i = 0; i < storeys.size(); ++i)
    panels.push_back({make_floor_raster(esdf, kFromAbove, storeys[i].band, config.width),
                      storeys[i].heights,
                      "Storey " + std::to_string(i + 1) + " of " + std::to_string(storeys.size()) +
                          ", heights " + between(storeys[i].heights) + ", walls at " +
                          between(storeys[i].band),
                      {}});
}

/// From the front or from a side: cut at a coordinate, or seen through.
void add_side(const Roadmap& roadmap, const PictureConfig& config, const Projection& projection,
              const std::optional<double>& cut, std::vector<Panel>& panels) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::string axis = projection.along == 1 ? "y" : "x";
  if (!cut) {
    panels.push_back({make_floor_raster(esdf, projection, {}, config.width),
                      kAll,
                      "Seen through along " + axis,
                      {}});
    return;
  }
  const HeightBand there = make_floor_raster(esdf, projection, {}, config.width).band;
  if (*cut < there.low || *cut > there.high)
    throw InputError("section_" + axis, short_number(*cut, 3) + " is outside the map",
                     "give one from " + between(there));
  const HeightBand slab{*cut - 0.5 * esdf.voxel_size, *cut + 0.5 * esdf.voxel_size};
  const HeightBand near{slab.low - roadmap.min_clearance, slab.high + roadmap.min_clearance};
  panels.push_back({make_floor_raster(esdf, projection, slab, config.width),
                    near,
                    "Section at " + axis + " = " + short_number(*cut, 3) +
                        " m; of the rest what is within " + short_number(roadmap.min_clearance, 3) +
                        " m of it",
                    {}});
}

}  // namespace

std::vector<Panel> make_panels(const Roadmap& roadmap, const PictureConfig& config) {
  std::vector<Panel> panels;
  add_plans(roadmap, config, panels);
  if (config.sides || config.section_y)
    add_side(roadmap, config, kFromFront, config.section_y, panels);
  if (config.sides || config.section_x)
    add_side(roadmap, config, kFromSide, config.section_x, panels);
  if (panels.size() == 1) panels.front().caption.clear();
  return panels;
}

double lay_out_panels(std::vector<Panel>& panels, double voxel_size, double left, double top,
                      double width, double unit) {
  double across = 0.0, down = 0.0;  // metres
  for (const Panel& panel : panels) {
    across = std::max(across, panel.raster.width(voxel_size));
    down += panel.raster.height(voxel_size);
  }
  // One map is up to as high as three quarters of a page's width allow, several twice that.
  const double most_down = (panels.size() == 1 ? 1.2 : 2.4) * 1600.0 * unit;
  const double scale = std::min(width / across, most_down / down);
  for (Panel& panel : panels) {
    if (!panel.caption.empty()) top += kPanelCaption * unit;
    MapFrame& frame = panel.frame;
    frame.projection = panel.raster.projection;
    frame.range = panel.range;
    frame.unit = unit;
    frame.scale = scale;
    frame.width = panel.raster.width(voxel_size) * scale;
    frame.height = std::max(panel.raster.height(voxel_size) * scale, unit);
    frame.left = left + 0.5 * (width - across * scale);
    frame.top = top;
    frame.min = panel.raster.min_corner(voxel_size);
    top += frame.height + kPanelAxis * unit;
  }
  return top;
}

}  // namespace ridgeway
