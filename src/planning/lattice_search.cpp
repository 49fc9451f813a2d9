// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "lattice_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <queue>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kRoot2 = 1.41421356237309504880, kRoot3 = 1.73205080756887729352;
constexpr std::array<double, 4> kLengths{0.0, 1.0, kRoot2, kRoot3};
constexpr int kExpansionsBetweenLooksAtTheClock = 1024;

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
    std::array<bool, kBlockVoxels> closed{};
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

struct OpenEntry {
  double estimate;
  double cost;
  VoxelId voxel;
  bool operator<(const OpenEntry& other) const {  // the queue's top is the best
    if (estimate != other.estimate) return estimate > other.estimate;
    if (cost != other.cost) return cost < other.cost;
    return voxel > other.voxel;
  }
};

std::vector<VoxelId> trace_back(const BlockLayout& layout, SearchMemory& memory, VoxelId start,
                                VoxelId goal) {
  std::vector<VoxelId> voxels{goal};
  for (VoxelId id = goal; id != start;) {
    id = layout.neighbour(id, memory.block_of(id).from[id % kBlockVoxels]);
    voxels.push_back(id);
  }
  std::reverse(voxels.begin(), voxels.end());
  return voxels;
}

}  // namespace

LatticePath search_lattice(const EsdfMap& esdf, VoxelId start, VoxelId goal, double radius,
                           const VoxelMask* within, const Deadline& deadline) {
  const double threshold = squared_threshold(radius, esdf.voxel_size);
  const FreeSpace space(esdf);
  const VoxelIndex target = esdf.layout.index_of(goal);
  const auto heuristic = [&](VoxelId id) {
    return lattice_distance(esdf.layout.index_of(id), target);
  };
  SearchMemory memory(esdf.layout.block_count());
  std::priority_queue<OpenEntry> open;
  memory.block_of(start).cost[start % kBlockVoxels] = 0.0;
  open.push({heuristic(start), 0.0, start});
  for (int expansions = 1; !open.empty(); ++expansions) {
    const OpenEntry best = open.top();
    open.pop();
    SearchMemory::Block& block = memory.block_of(best.voxel);
    if (block.closed[best.voxel % kBlockVoxels]) continue;
    block.closed[best.voxel % kBlockVoxels] = true;
    if (best.voxel == goal)
      return {SearchStatus::kFound, trace_back(esdf.layout, memory, start, goal), best.cost};
    if (expansions % kExpansionsBetweenLooksAtTheClock == 0 && deadline.has_passed())
      return {SearchStatus::kTimeout, {}};
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf.layout.neighbour(best.voxel, d);
      if (d == kCentre || next == kNoVoxel || esdf.squared[next] < threshold ||
          esdf.state[next] != VoxelState::kFree || (within != nullptr && !within->test(next)))
        continue;
      SearchMemory::Block& there = memory.block_of(next);
      const std::size_t place = next % kBlockVoxels;
      const double cost = best.cost + kLengths[static_cast<std::size_t>(squared_length(d))];
      if (there.closed[place] || cost >= there.cost[place]) continue;
      if (!space.move_is_free(best.voxel, next, d, threshold)) continue;
      there.cost[place] = cost;
      there.from[place] = static_cast<Direction>(opposite(d));
      open.push({cost + heuristic(next), cost, next});
    }
  }
  return {SearchStatus::kNoRoute, {}};
}

}  // namespace ridgeway::detail
