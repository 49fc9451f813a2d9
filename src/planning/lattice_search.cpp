// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "lattice_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>

#include "open_buckets.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "voxel/beyond_parent.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kRoot2 = 1.41421356237309504880, kRoot3 = 1.73205080756887729352;
/// Lengths of the steps in the 27 directions, voxels.
constexpr std::array<double, 27> kLengths = [] {
  std::array<double, 27> lengths{};
  for (int d = 0; d < 27; ++d)
    lengths[static_cast<std::size_t>(d)] =
        std::array{0.0, 1.0, kRoot2, kRoot3}[static_cast<std::size_t>(squared_length(d))];
  return lengths;
}();
constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kNoGain = 1e-9;  // voxels

/// Length of the shortest 26-path between two voxels of empty space.
inline double lattice_distance(const VoxelIndex& a, const VoxelIndex& b) {
  const int x = std::abs(a.x - b.x), y = std::abs(a.y - b.y), z = std::abs(a.z - b.z);
  const int least = std::min({x, y, z}), most = std::max({x, y, z});
  const int middle = x + y + z - least - most;
  return (kRoot3 - kRoot2) * least + (kRoot2 - 1.0) * middle + most;
}

/// Costs and parents of the voxels seen so far, a block at a time. Blocks are found through pages
/// of pointers, so that a short search in a large map does not begin by clearing a pointer a block.
class SearchMemory {
 public:
  struct Block {
    std::array<double, kBlockVoxels> cost;
    std::array<std::uint8_t, kBlockVoxels> from;  // direction back to the parent, and kOpen
    Block() { cost.fill(std::numeric_limits<double>::infinity()); }
  };

  explicit SearchMemory(std::uint32_t blocks) : pages_(blocks / kPageBlocks + 1) {}

  Block& block_of(VoxelId id) {
    const std::uint32_t slot = id / kBlockVoxels;
    std::unique_ptr<Page>& page = pages_[slot / kPageBlocks];
    if (!page) page = std::make_unique<Page>();
    std::unique_ptr<Block>& block = (*page)[slot % kPageBlocks];
    if (!block) block = std::make_unique<Block>();
    return *block;
  }
  /// Infinite for what was not reached, kNoVoxel with it.
  double cost_of(VoxelId id) const {
    const Block* block = id == kNoVoxel ? nullptr : find_block(id);
    return block == nullptr ? std::numeric_limits<double>::infinity()
                            : block->cost[id % kBlockVoxels];
  }
  std::uint8_t& from(VoxelId id) { return block_of(id).from[id % kBlockVoxels]; }

 private:
  static constexpr std::uint32_t kPageBlocks = 512;
  using Page = std::array<std::unique_ptr<Block>, kPageBlocks>;

  const Block* find_block(VoxelId id) const {
    const std::uint32_t slot = id / kBlockVoxels;
    const Page* page = pages_[slot / kPageBlocks].get();
    return page == nullptr ? nullptr : (*page)[slot % kPageBlocks].get();
  }

  std::vector<std::unique_ptr<Page>> pages_;
};

/// Set beside a voxel's direction once it was expanded and each neighbour could be moved to, or had
/// been reached as cheaply before.
constexpr std::uint8_t kOpen = 32;

class LatticeSearch {
 public:
  LatticeSearch(const FreeSpace& space, VoxelId start, VoxelId goal, double radius,
                const LatticeOptions& options)
      : esdf_(space.map()),
        space_(space),
        options_(options),
        start_(start),
        goal_(goal),
        target_(esdf_.layout.index_of(goal)),
        threshold_(least_clearance(space.inner_radius(radius), esdf_.voxel_size)),
        memory_(esdf_.layout.block_count()),
        open_(estimate(esdf_.layout.index_of(start))) {}

  LatticePath run(const Deadline& deadline) {
    reach(start_, {0.0, kCentre}, estimate(esdf_.layout.index_of(start_)));
    const double& goal_cost = memory_.block_of(goal_).cost[goal_ % kBlockVoxels];
    const int between_looks = space_.is_for_sphere() ? 1024 : 32;  // at the clock
    int expansions = 0;
    while (const std::optional<OpenBuckets::Entry> best = open_.pop(goal_cost)) {
      if (best->cost > memory_.cost_of(best->voxel)) continue;
      if (++expansions > options_.most_expansions) break;
      if (expansions % between_looks == 0 && deadline.has_passed())
        return {SearchStatus::kTimeout, {}};
      look_around(best->voxel, best->cost);
    }
    if (std::isinf(goal_cost)) return {SearchStatus::kNoRoute, {}};
    return {SearchStatus::kFound, trace_back(), goal_cost};
  }

 private:
  struct Arrival {
    double cost;  // voxels
    Direction from;
  };

  /// Of the way on from a voxel; kNone where the guide knows none.
  double estimate(const VoxelIndex& voxel) const {
    const double distance = lattice_distance(voxel, target_);
    if (options_.guide == nullptr) return distance;
    return std::max(distance, options_.guide->rest_from(voxel));
  }

  bool is_taken(VoxelId id) const {
    return esdf_.squared[id] >= threshold_ && esdf_.is_open(id) &&
           (options_.within == nullptr || options_.within->test(id)) && space_.is_within_limits(id);
  }

  void reach(VoxelId id, const Arrival& arrival, double estimate) {
    SearchMemory::Block& block = memory_.block_of(id);
    block.cost[id % kBlockVoxels] = arrival.cost;
    block.from[id % kBlockVoxels] = arrival.from;
    open_.push(estimate, {arrival.cost, id});
  }

  /// Neighbours that a voxel may be the way to. Where its parent is open, the parent's neighbours
  /// have been reached, and as cheaply.
  Cube27 worth_a_look(VoxelId id) {
    const std::uint8_t from = memory_.from(id) & ~kOpen;
    if (from == kCentre) return kCells26;
    const VoxelId parent = esdf_.layout.neighbour(id, from);
    return (memory_.from(parent) & kOpen) != 0 ? kBeyondParent[from] : kCells26;
  }

  void look_around(VoxelId id, double own) {
    const VoxelIndex here = esdf_.layout.index_of(id);
    const SearchMemory::Block& block = memory_.block_of(id);
    bool all_free = true;
    for (Cube27 left = worth_a_look(id); left != 0; left &= left - 1) {
      const int d = std::countr_zero(left);
      const bool is_near = has_neighbour_in_block(id, d);
      const VoxelId next = is_near ? neighbour_in_block(id, d) : esdf_.layout.neighbour(id, d);
      // Most neighbours were reached before, and as cheaply: that is asked first. Sums of the same
      // steps in another order may differ in the last digit: no improvement.
      const double cost = own + kLengths[static_cast<std::size_t>(d)];
      const double known = is_near ? block.cost[next % kBlockVoxels] : memory_.cost_of(next);
      if (cost > known - kNoGain) continue;
      const VoxelIndex there = here + offset_of(d);
      if (cost + lattice_distance(there, target_) > options_.longest) continue;
      const bool is_legal =
          next != kNoVoxel && is_taken(next) && space_.move_is_free(id, next, d, threshold_);
      const double to_go = is_legal ? estimate(there) : kNone;
      if (to_go == kNone) {
        all_free = false;
        continue;
      }
      reach(next, {cost, static_cast<Direction>(opposite(d))}, cost + to_go);
    }
    if (all_free) memory_.from(id) |= kOpen;
  }

  std::vector<VoxelId> trace_back() {
    std::vector<VoxelId> voxels{goal_};
    while (voxels.back() != start_)
      voxels.push_back(esdf_.layout.neighbour(voxels.back(), memory_.from(voxels.back()) & ~kOpen));
    std::reverse(voxels.begin(), voxels.end());
    return voxels;
  }

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const LatticeOptions options_;
  const VoxelId start_, goal_;
  const VoxelIndex target_;
  const SquaredHalves threshold_;
  SearchMemory memory_;
  OpenBuckets open_;
};

}  // namespace

LatticePath search_lattice(const FreeSpace& space, VoxelId start, VoxelId goal, double radius,
                           const LatticeOptions& options, const Deadline& deadline) {
  return LatticeSearch(space, start, goal, radius, options).run(deadline);
}

}  // namespace ridgeway::detail
