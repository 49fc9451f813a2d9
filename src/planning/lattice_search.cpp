// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "lattice_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "open_buckets.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kRoot2 = 1.41421356237309504880, kRoot3 = 1.73205080756887729352;
constexpr std::array<double, 4> kLengths{0.0, 1.0, kRoot2, kRoot3};
constexpr double kNoGain = 1e-9;  // voxels
constexpr int kExpansionsBetweenLooks = 1024;

/// Length of the shortest 26-path between two voxels of empty space.
double lattice_distance(const VoxelIndex& a, const VoxelIndex& b) {
  std::array<int, 3> d{std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)};
  std::sort(d.begin(), d.end());
  return (kRoot3 - kRoot2) * d[0] + (kRoot2 - 1.0) * d[1] + d[2];
}

/// Costs and parents of the voxels seen so far, a block at a time.
class SearchMemory {
 public:
  struct Block {
    std::array<double, kBlockVoxels> cost;
    std::array<Direction, kBlockVoxels> from;  // direction back to the parent
    Block() { cost.fill(std::numeric_limits<double>::infinity()); }
  };

  explicit SearchMemory(std::uint32_t blocks) : blocks_(blocks) {}

  Block& block_of(VoxelId id) {
    std::unique_ptr<Block>& block = blocks_[id / kBlockVoxels];
    if (!block) block = std::make_unique<Block>();
    return *block;
  }

 private:
  std::vector<std::unique_ptr<Block>> blocks_;
};

std::vector<VoxelId> trace_back(const BlockLayout& layout, SearchMemory& memory, VoxelId start,
                                VoxelId goal) {
  std::vector<VoxelId> voxels{goal};
  for (VoxelId id = goal; id != start;) {
    const VoxelIndex& o = offset_of(memory.block_of(id).from[id % kBlockVoxels]);
    id = layout.step(id, o.x, o.y, o.z);
    voxels.push_back(id);
  }
  std::reverse(voxels.begin(), voxels.end());
  return voxels;
}

}  // namespace

LatticePath search_lattice(const FreeSpace& space, VoxelId start, VoxelId goal, double radius,
                           const LatticeOptions& options, const Deadline& deadline) {
  const EsdfMap& esdf = space.map();
  const SquaredHalves threshold = least_clearance(space.inner_radius(radius), esdf.voxel_size);
  const VoxelIndex target = esdf.layout.index_of(goal);
  SearchMemory memory(esdf.layout.block_count());
  const double least = options.weight * lattice_distance(esdf.layout.index_of(start), target);
  OpenBuckets open(least);
  memory.block_of(start).cost[start % kBlockVoxels] = 0.0;
  open.push(least, {0.0, start});
  double& goal_cost = memory.block_of(goal).cost[goal % kBlockVoxels];
  int expansions = 0;
  while (const std::optional<OpenBuckets::Entry> best = open.pop(goal_cost)) {
    if (best->cost > memory.block_of(best->voxel).cost[best->voxel % kBlockVoxels]) continue;
    if (++expansions > options.most_expansions) break;
    if (expansions % kExpansionsBetweenLooks == 0 && deadline.has_passed())
      return {SearchStatus::kTimeout, {}};
    const VoxelIndex here = esdf.layout.index_of(best->voxel);
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex& o = offset_of(d);
      const VoxelId next = esdf.layout.step(best->voxel, o.x, o.y, o.z);
      if (d == kCentre || next == kNoVoxel || esdf.squared[next] < threshold ||
          !esdf.is_open(next) || (options.within != nullptr && !options.within->test(next)) ||
          !space.is_within_limits(next))
        continue;
      SearchMemory::Block& there = memory.block_of(next);
      const std::size_t place = next % kBlockVoxels;
      const double cost = best->cost + kLengths[static_cast<std::size_t>(squared_length(d))];
      // Sums of the same steps in another order may differ in the last digit: no improvement.
      if (cost > there.cost[place] - kNoGain) continue;
      const VoxelIndex there_index = here + o;
      const double to_go = lattice_distance(there_index, target);
      if (cost + to_go > options.longest || !space.move_is_free(best->voxel, next, d, threshold))
        continue;
      there.cost[place] = cost;
      there.from[place] = static_cast<Direction>(opposite(d));
      open.push(cost + options.weight * to_go, {cost, next});
    }
  }
  if (std::isinf(goal_cost)) return {SearchStatus::kNoRoute, {}};
  return {SearchStatus::kFound, trace_back(esdf.layout, memory, start, goal), goal_cost};
}

}  // namespace ridgeway::detail
