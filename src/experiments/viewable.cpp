// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "viewable.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

constexpr double kBetweenPlaces = 0.5;  // metres
constexpr double kPatience = 4.0;       // metres: places nearer than this are all asked

/// Voxels at whose centres a sphere fits into the exact world: a wall that is thinner than a voxel
/// may leave no voxel of a map of the world occupied.
VoxelMask where_it_fits(const World& world, const EsdfMap& esdf, double radius) {
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  const World all = world_at_all_times(world);
  VoxelMask fits(esdf.layout);
  parallel_for_each_index(esdf.layout.block_count(), [&](std::size_t slot) {
    const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
      if (!esdf.is_open(id) || esdf.squared[id] < threshold) continue;
      const Point centre = to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
      if (surface_distance(all, centre).distance >= radius) fits.set(id);
    }
  });
  return fits;
}

/// Centres of the voxels that a sphere gets to from a start. Between neighbours that it fits on no
/// wall has room, unless it is smaller than voxels.
std::vector<Point> places_reached(const World& world, const EsdfMap& esdf, const Point& start,
                                  double radius) {
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  const FreeSpace space(esdf);
  const VoxelId first = esdf.layout.find(voxel_at(to_local(esdf, start), esdf.voxel_size));
  std::vector<Point> places;
  const VoxelMask fits = where_it_fits(world, esdf, radius);
  if (first == kNoVoxel || !fits.test(first)) return places;
  VoxelMask reached(esdf.layout);
  std::vector<VoxelId> queue = {first};
  reached.set(first);
  const int stride = std::max(1, static_cast<int>(kBetweenPlaces / esdf.voxel_size));
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const VoxelIndex voxel = esdf.layout.index_of(queue[i]);
    if (voxel.x % stride == 0 && voxel.y % stride == 0 && voxel.z % stride == 0)
      places.push_back(to_world(esdf, centre_of(voxel, esdf.voxel_size)));
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf.layout.neighbour(queue[i], d);
      if (next == kNoVoxel || reached.test(next) || !fits.test(next)) continue;
      if (!space.move_is_free(queue[i], next, d, threshold)) continue;
      reached.set(next);
      queue.push_back(next);
    }
  }
  return places;
}

/// Free voxels that others join to a place: only those can be seen, but through what is narrower
/// than a voxel. It takes a ray from every place to find that a voxel is seen from none.
VoxelMask around(const OccupancyMap& truth, const Point& place) {
  VoxelMask joined(truth.layout);
  const VoxelId first = truth.layout.find(voxel_at(to_local(truth, place), truth.voxel_size));
  if (first == kNoVoxel || truth.state[first] != VoxelState::kFree) return joined;
  std::vector<VoxelId> queue = {first};
  joined.set(first);
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = truth.layout.neighbour(queue[i], d);
      if (next == kNoVoxel || joined.test(next) || truth.state[next] != VoxelState::kFree) continue;
      joined.set(next);
      queue.push_back(next);
    }
  return joined;
}

bool is_in_view(const World& world, const FieldOfView& view, const Point& from, const Point& to) {
  const Eigen::Vector3d way = to - from;
  const double distance = way.norm();
  if (distance > view.range || distance < view.nearest) return false;
  const double level = std::hypot(way.x(), way.y());
  if (std::abs(way.z()) > level * std::tan(0.5 * view.vertical)) return false;
  return cast_ray(world, from, way / distance) >= distance;
}

}  // namespace

ViewableVolume::ViewableVolume(const World& world, double voxel_size, const VoxelRange& within,
                               const Point& start, double radius, const FieldOfView& view)
    : voxel_volume_(voxel_size * voxel_size * voxel_size) {
  const auto corner = [&](const VoxelIndex& v) -> Point {
    return Point(v.x, v.y, v.z) * voxel_size;
  };
  const OccupancyMap truth = occupancy_of(
      world, voxel_size, {corner(within.min), corner(within.max + VoxelIndex{1, 1, 1})});
  const EsdfMap esdf = compute_esdf(truth);
  const std::vector<Point> places = places_reached(world, esdf, start, radius);
  // Places by cells of a few metres, so that near ones are found.
  std::unordered_map<BlockIndex, std::vector<std::size_t>, BlockHash> near;
  const auto cell_of = [](const Point& p) {
    const VoxelIndex v = voxel_at(p, kPatience);
    return BlockIndex{v.x, v.y, v.z};
  };
  for (std::size_t i = 0; i < places.size(); ++i) near[cell_of(places[i])].push_back(i);
  const BlockLayout& layout = truth.layout;
  const VoxelMask joined = around(truth, start);
  std::vector<VoxelMask::Block> seen(layout.block_count());
  parallel_for_each_index(layout.block_count(), [&](std::size_t block) {
    std::size_t lucky = 0;  // the place that saw the last voxel mostly sees the next
    for (int local = 0; local < kBlockVoxels; ++local) {
      const VoxelIndex own = voxel_of(layout.block(static_cast<std::uint32_t>(block)), local);
      const auto id = static_cast<VoxelId>(block * kBlockVoxels + static_cast<std::size_t>(local));
      if (!joined.test(id) || !within.contains(own + truth.origin)) continue;
      const Point centre = to_world(truth, centre_of(own, voxel_size));
      const auto is_seen_from = [&](std::size_t i) {
        if (!is_in_view(world, view, places[i], centre)) return false;
        lucky = i;
        return true;
      };
      const auto is_seen = [&] {
        if (places.empty()) return false;
        if (is_seen_from(lucky)) return true;
        const BlockIndex cell = cell_of(centre);
        for (int d = 0; d < 27; ++d) {
          const VoxelIndex& o = offset_of(d);
          const auto found = near.find(cell + BlockIndex{o.x, o.y, o.z});
          if (found != near.end() &&
              std::any_of(found->second.begin(), found->second.end(), is_seen_from))
            return true;
        }
        for (std::size_t i = 0; i < places.size(); ++i)
          if ((places[i] - centre).norm() <= view.range && is_seen_from(i)) return true;
        return false;
      };
      if (is_seen())
        seen[block][static_cast<std::size_t>(local) / 64] |= std::uint64_t{1} << local % 64;
    }
  });
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    for (int local = 0; local < kBlockVoxels; ++local)
      if ((seen[slot][static_cast<std::size_t>(local) / 64] >> local % 64 & 1) != 0) {
        const VoxelIndex voxel = truth.origin + voxel_of(layout.block(slot), local);
        const auto place = static_cast<std::size_t>(local_of(voxel));
        members_[block_of(voxel)][place / 64] |= std::uint64_t{1} << place % 64;
        ++voxels_;
      }
}

std::vector<VoxelIndex> ViewableVolume::some(std::size_t count) const {
  std::vector<VoxelIndex> all;
  all.reserve(voxels_);
  for (const auto& [block, members] : members_)
    for (int local = 0; local < kBlockVoxels; ++local)
      if ((members[static_cast<std::size_t>(local) / 64] >> local % 64 & 1) != 0)
        all.push_back(voxel_of(block, local));
  std::sort(all.begin(), all.end());
  if (all.size() <= count) return all;
  std::vector<VoxelIndex> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

std::size_t ViewableVolume::known_in(const EsdfMap& esdf, std::uint32_t slot,
                                     const VoxelMask::Block& members) {
  const VoxelState* const states = esdf.state.block(slot);
  std::size_t known = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z)
    for (std::uint64_t bits = members[z]; bits != 0; bits &= bits - 1)
      known +=
          states[64 * z + static_cast<std::size_t>(std::countr_zero(bits))] != VoxelState::kUnknown;
  return known;
}

std::size_t ViewableVolume::known_of(std::shared_ptr<const Roadmap> now) {
  const BlockLayout& layout = now->esdf.layout;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    const auto found = members_.find(layout.block(slot));
    if (found == members_.end()) continue;
    if (last_) {
      const std::uint32_t before = last_->esdf.layout.find_block(layout.block(slot));
      if (before != BlockLayout::kNoBlock &&
          last_->esdf.state.block(before) == now->esdf.state.block(slot))
        continue;
    }
    known_[layout.block(slot)] = known_in(now->esdf, slot, found->second);
  }
  last_ = std::move(now);
  std::size_t known = 0;
  for (const auto& [block, count] : known_) known += count;
  return known;
}

}  // namespace ridgeway
