// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "memory_traffic.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/planning/check.hpp"

namespace ridgeway::detail {
namespace {

// Bytes a voxel, of the fields as they are.
constexpr double kState = sizeof(std::declval<EsdfMap&>().state[0]);
constexpr double kSquared = sizeof(std::declval<EsdfMap&>().squared[0]);
constexpr double kNext = sizeof(std::declval<AttachField&>().next[0]);
constexpr double kMask = static_cast<double>(sizeof(VoxelMask::Block)) / kBlockVoxels;

}  // namespace

StageNumbers least_traffic(const BuildReport& counts, bool near_sites) {
  const double site = near_sites ? sizeof(NearSiteOffset) : sizeof(SiteOffset);
  const auto allocated = static_cast<double>(counts.allocated_voxels);
  const auto traversable = static_cast<double>(counts.traversable_voxels);
  const auto diagram = static_cast<double>(counts.diagram_voxels);
  StageNumbers bytes;
  // Obstacles; three sweeps that write distances and sites, of which the first reads obstacles, the
  // others distances; a look for those too far; traversable voxels.
  const double sweeps = kMask + 2.0 * kSquared + 3.0 * (kSquared + site);
  bytes.esdf = allocated * (kState + kMask + sweeps + kSquared +  //
                            kState + kSquared + kMask);
  // Sites of the traversable voxels. Those of the neighbours beyond are not counted.
  bytes.gvd = 2.0 * allocated * kMask + traversable * site;
  bytes.edges = 2.0 * allocated * kMask;
  bytes.thin = 2.0 * allocated * kMask;
  // Basins: heights to ways. Kernel: heights once more, to order the deletions.
  bytes.kernel =
      2.0 * allocated * kMask + traversable * (kSquared + kNext) + traversable * kSquared;
  // The diagram is found in its mask; then it is a list.
  bytes.graph = allocated * kMask + diagram * kSquared;
  bytes.attach = allocated * kMask + diagram * (kSquared + kNext);
  // One look for the widest place of each cell; the rest is queries, here and there.
  bytes.tangents = allocated * kNext + traversable * kSquared;
  bytes.esdf_to_graph = bytes.gvd + bytes.edges + bytes.thin + bytes.kernel + bytes.graph;
  bytes.total = bytes.esdf + bytes.esdf_to_graph + bytes.attach + bytes.tangents;
  return bytes;
}

StageNumbers voxels_walked(const BuildReport& counts) {
  const auto traversable = static_cast<double>(counts.traversable_voxels);
  const auto diagram = static_cast<double>(counts.diagram_voxels);
  StageNumbers voxels;
  voxels.esdf = voxels.tangents = static_cast<double>(counts.allocated_voxels);
  voxels.gvd = voxels.kernel = voxels.esdf_to_graph = traversable;
  voxels.edges = static_cast<double>(counts.gvd_voxels);
  voxels.thin = static_cast<double>(counts.edge_voxels);
  voxels.graph = voxels.attach = diagram;
  voxels.total = static_cast<double>(counts.voxels.known());
  return voxels;
}

double copy_bandwidth(std::size_t bytes, int repeat) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  const std::vector<std::byte> from(bytes, std::byte{1});
  std::vector<std::byte> to(bytes);  // its pages are there before the clock runs
  std::vector<double> seconds;
  for (int run = 0; run < repeat; ++run) {
    const double begin = seconds_now();
    parallel_for_each_index((bytes + kPiece - 1) / kPiece, [&](std::size_t i) {
      const std::size_t first = i * kPiece;
      std::memcpy(to.data() + first, from.data() + first, std::min(kPiece, bytes - first));
    });
    seconds.push_back(seconds_now() - begin);
  }
  return 2.0 * static_cast<double>(bytes) / spread_of(std::move(seconds)).median;
}

}  // namespace ridgeway::detail
