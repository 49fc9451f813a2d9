// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/esdf.hpp"

#include <algorithm>
#include <cassert>
#include <type_traits>
#include <vector>

#include "common/number_text.hpp"
#include "distance_sweeps.hpp"
#include "mapping/memory_limit.hpp"
#include "mapping/planar.hpp"
#include "mapping/require_states.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "site_limit.hpp"
#include "voxel/mask_sets.hpp"
#include "work_domain.hpp"

namespace ridgeway {
namespace {

using detail::NearestSites;

constexpr int kSweepBytesPerVoxel = 8;  // of blocks that sweeps pass through, with the layout

VoxelMask find_obstacles(const BlockLayout& layout, const VoxelField<VoxelState>& state,
                         UnknownPolicy unknown) {
  assert(state.is_of(layout));
  VoxelMask obstacle(layout);
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t slot) {
        const auto block = static_cast<std::uint32_t>(slot);
        const VoxelState* states = state.block(block);
        obstacle.block(block) = block_where([&](int v) { return is_obstacle(states[v], unknown); });
      },
      16);
  return obstacle;
}

/// Carries a field over to another layout that holds all blocks it shares with the first.
template <typename Value>
VoxelField<Value> move_to_layout(const BlockLayout& from, const VoxelField<Value>& field,
                                 const BlockLayout& to, std::type_identity_t<Value> absent,
                                 Pages pages = Pages::kUsual) {
  assert(field.is_of(from));
  auto result = VoxelField<Value>::unset(to, pages);
  parallel_for_each_index(
      to.block_count(),
      [&](std::size_t slot) {
        const auto target = static_cast<std::uint32_t>(slot);
        const std::uint32_t source = from.find_block(to.block(target));
        if (source != BlockLayout::kNoBlock) {
          std::copy_n(field.block(source), kBlockVoxels, result.block(target));
        } else {
          std::fill_n(result.block(target), kBlockVoxels, absent);
        }
      },
      64);
  return result;
}

/// Sites where unknown space is no obstacle: the sweeps must pass through blocks that the map has
/// not allocated, so they run on a larger layout.
NearestSites sweep_through_unknown(const EsdfMap& map, double farthest) {
  std::vector<bool> occupied(map.layout.block_count());
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    occupied[slot] = !detail::is_empty(map.obstacle.block(slot));
  const BlockLayout domain =
      detail::sweep_domain(map.layout, occupied, farthest, kSweepBytesPerVoxel);
  VoxelMask obstacle(domain);
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    obstacle.block(domain.find_block(map.layout.block(slot))) = map.obstacle.block(slot);
  NearestSites nearest = detail::sweep_distances(domain, obstacle, false, map.planar, farthest);
  if (domain == map.layout) return nearest;
  nearest.squared = move_to_layout(domain, nearest.squared, map.layout, kNoSite, Pages::kLarge);
  nearest.offset = nearest.offset.visit([&](const auto& offset) {
    return SiteField(move_to_layout(domain, offset, map.layout, {}));
  });
  return nearest;
}

/// Adds all blocks of the box around those in which something is known.
BlockLayout with_blocks_between(const OccupancyMap& map) {
  const VoxelRange known = known_range(map);
  if (known.empty()) return map.layout;
  require_memory_for_blocks(known.block_count(), kEsdfBytesPerVoxel, "map");
  const BlockIndex first = block_of(known.min), last = block_of(known.max);
  std::vector<BlockIndex> missing;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x)
        if (map.layout.find_block({x, y, z}) == BlockLayout::kNoBlock) missing.push_back({x, y, z});
  if (!map.layout.is_in_order()) {
    BlockLayout grown = map.layout;
    grown.add(missing);
    return grown;
  }
  missing.insert(missing.end(), map.layout.blocks().begin(), map.layout.blocks().end());
  return BlockLayout(std::move(missing));
}

/// Sites that are too far become none.
void drop_far_sites(EsdfMap& map, double farthest) {
  const std::uint32_t limit = detail::largest_kept(farthest);
  parallel_for_each_index(
      map.layout.block_count(),
      [&](std::size_t index) {
        const auto slot = static_cast<std::uint32_t>(index);
        std::uint32_t* squared = map.squared.block(slot);
        for (std::uint32_t v = 0; v < kBlockVoxels; ++v) {
          if (squared[v] <= limit) continue;
          squared[v] = kNoSite;
          map.site.set(slot * kBlockVoxels + v, {});
        }
      },
      16);
}

}  // namespace

void validate_policy(UnknownPolicy policy) {
  if (policy > UnknownPolicy::kFree)
    throw InputError("unknown", "is no enumerator of UnknownPolicy",
                     "give kObstacle, kIgnore or kFree");
}

void EsdfConfig::validate() const {
  validate_policy(unknown);
  limits.validate();
  if (!(max_distance > 0.0))
    throw InputError("max_distance", "is " + number_text(max_distance),
                     "give a length above 0 metres, or leave it out for no limit");
}

EsdfMap compute_esdf(OccupancyMap map, const EsdfConfig& config) {
  config.validate();
  validate_voxel_size(map.voxel_size, "voxel_size");
  detail::require_states(map);
  EsdfMap esdf;
  esdf.voxel_size = map.voxel_size;
  esdf.origin = map.origin;
  esdf.unknown = config.unknown;
  esdf.max_distance = config.max_distance;
  esdf.planar = map.planar;
  esdf.limits = limits_in_local(esdf, config.limits);
  if (esdf.planar) {
    static_assert(kPlanarLayer == detail::kStandingLayer);
    const double height = (kPlanarLayer + 0.5) * esdf.voxel_size;
    esdf.limits.keep_in.min.z() = esdf.limits.keep_in.max.z() = height;
  }
  const double farthest = config.max_distance / map.voxel_size;
  const bool solid_unknown = config.unknown == UnknownPolicy::kObstacle;
  if (solid_unknown) {
    esdf.layout = std::move(map.layout);
    esdf.state = std::move(map.state);
  } else {
    esdf.layout = config.unknown == UnknownPolicy::kFree
                      ? with_blocks_between(map)
                      : detail::with_neighbour_blocks(map.layout, map.planar);
    require_memory_for_blocks(esdf.layout.block_count(), kEsdfBytesPerVoxel, "map");
    esdf.state = move_to_layout(map.layout, map.state, esdf.layout, VoxelState::kUnknown);
  }
  esdf.obstacle = find_obstacles(esdf.layout, esdf.state, esdf.unknown);
  NearestSites nearest = solid_unknown ? detail::sweep_distances(esdf.layout, esdf.obstacle, true,
                                                                 esdf.planar, farthest)
                                       : sweep_through_unknown(esdf, farthest);
  esdf.squared = std::move(nearest.squared);
  esdf.site = std::move(nearest.offset);
  drop_far_sites(esdf, farthest);
  return esdf;
}

OccupancyMap occupancy_of(const EsdfMap& esdf) {
  return {esdf.voxel_size, esdf.origin, esdf.layout, esdf.state, esdf.planar};
}

}  // namespace ridgeway
