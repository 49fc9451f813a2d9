// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "widest_place.hpp"

namespace ridgeway::detail {

std::optional<WidestPlace> widest_place(const EsdfMap& esdf) {
  VoxelId widest = kNoVoxel;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (!esdf.is_open(id)) continue;
    const auto is_first = [&] { return esdf.layout.index_of(id) < esdf.layout.index_of(widest); };
    const bool is_wider = widest == kNoVoxel || esdf.squared[id] > esdf.squared[widest] ||
                          (esdf.squared[id] == esdf.squared[widest] && is_first());
    if (is_wider && esdf.limits.allow_voxel(esdf.layout.index_of(id), esdf.voxel_size)) widest = id;
  }
  if (widest == kNoVoxel) return std::nullopt;
  const Point centre = centre_of(esdf.layout.index_of(widest), esdf.voxel_size);
  return WidestPlace{to_world(esdf, centre), esdf.distance(widest)};
}

}  // namespace ridgeway::detail
