// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "voxel_route.hpp"

namespace ridgeway::detail {

Route route_over_voxels(const EsdfMap& esdf, const RouteQuery& query,
                        const std::vector<VoxelId>& voxels) {
  Route route{query.start};
  VoxelIndex last_step{};
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const VoxelIndex here = esdf.layout.index_of(voxels[i]);
    const VoxelIndex step =
        i + 1 < voxels.size() ? esdf.layout.index_of(voxels[i + 1]) - here : VoxelIndex{};
    if (i == 0 || i + 1 == voxels.size() || step != last_step)
      route.push_back(centre_of(here, esdf.voxel_size));
    last_step = step;
  }
  route.push_back(query.goal);
  return route;
}

std::vector<VoxelId> join_ways(std::vector<VoxelId> a, std::vector<VoxelId> b) {
  while (a.size() > 1 && b.size() > 1 && a[a.size() - 2] == b[b.size() - 2]) {
    a.pop_back();
    b.pop_back();
  }
  b.pop_back();
  a.insert(a.end(), b.rbegin(), b.rend());
  return a;
}

}  // namespace ridgeway::detail
