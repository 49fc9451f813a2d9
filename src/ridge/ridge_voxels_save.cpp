// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>

#include "ridge_sections.hpp"
#include "ridgeway/common/error.hpp"
#include "site_codec.hpp"
#include "voxel_chunks.hpp"

namespace ridgeway {
namespace {

void fill_states(const EsdfMap& esdf, const BlockRange& range, std::vector<std::byte>& raw) {
  raw.reserve(range.count() * kBlockVoxels);
  for (std::uint32_t rank = range.first; rank < range.last; ++rank) {
    const VoxelId first = esdf.layout.slot_at(rank) * kBlockVoxels;
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
      const bool no_site = esdf.squared[id] == kNoSite;
      raw.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(esdf.state[id]) |
                                           (no_site ? kNoSiteFlag : 0)));
    }
  }
}

/// A distance that is not that of its site would come back as another one: refused.
void check_voxel(const EsdfMap& esdf, VoxelId id, bool obstacle) {
  const std::uint32_t squared = esdf.squared[id];
  const bool matches = squared == kNoSite
                           ? !obstacle && esdf.site[id] == SiteOffset{}
                           : squared == squared_halves(esdf.site[id]) && obstacle == (squared == 0);
  if (!matches || obstacle != esdf.obstacle.test(id) ||
      (obstacle && esdf.site[id] != SiteOffset{})) {
    const VoxelIndex v = esdf.layout.index_of(id);
    throw InputError("roadmap.esdf",
                     "distance, site and state of voxel " + std::to_string(v.x) + ", " +
                         std::to_string(v.y) + ", " + std::to_string(v.z) + " do not fit",
                     "save what build_roadmap returned");
  }
}

void gather_sites(const EsdfMap& esdf, std::uint32_t slot, SitePlanes& sites, BlockPlane& live) {
  for (std::uint32_t i = 0; i < kBlockVoxels; ++i) {
    const VoxelId id = slot * kBlockVoxels + i;
    const bool obstacle = is_obstacle(esdf.state[id], esdf.unknown);
    check_voxel(esdf, id, obstacle);
    live[i] = !obstacle && esdf.squared[id] != kNoSite ? -1 : 0;
    sites.x[i] = esdf.site[id].x;
    sites.y[i] = esdf.site[id].y;
    sites.z[i] = esdf.site[id].z;
  }
}

bool fits_byte(const BlockPlane& plane) {
  return std::all_of(plane.begin(), plane.end(), [](int v) { return v >= -128 && v <= 127; });
}

/// Three planes over the whole chunk, a byte a number where all fit, otherwise two.
void fill_sites(const EsdfMap& esdf, const BlockRange& range, std::vector<std::byte>& raw) {
  std::vector<SitePlanes> coded(range.count());
  bool narrow = true;
  for (std::size_t b = 0; b < range.count(); ++b) {
    SitePlanes sites;
    BlockPlane live;
    const std::uint32_t rank = range.first + static_cast<std::uint32_t>(b);
    gather_sites(esdf, esdf.layout.slot_at(rank), sites, live);
    coded[b] = encode_sites(sites, live);
    narrow = narrow && fits_byte(coded[b].x) && fits_byte(coded[b].y) && fits_byte(coded[b].z);
  }
  raw.reserve(range.count() * kBlockVoxels * 6);
  for (const auto axis : {&SitePlanes::x, &SitePlanes::y, &SitePlanes::z}) {
    for (const SitePlanes& block : coded) {
      for (const std::int16_t value : block.*axis) {
        raw.push_back(static_cast<std::byte>(value & 255));
        if (!narrow) raw.push_back(static_cast<std::byte>(value >> 8 & 255));
      }
    }
  }
}

/// The bytes of the blocks of a range; block_of(slot) gives a block's.
template <typename BlockOf>
void fill_plain(const BlockLayout& layout, const BlockRange& range, const BlockOf& block_of,
                std::vector<std::byte>& raw) {
  for (std::uint32_t rank = range.first; rank < range.last; ++rank) {
    const std::span<const std::byte> bytes = block_of(layout.slot_at(rank));
    raw.insert(raw.end(), bytes.begin(), bytes.end());
  }
}

}  // namespace

std::vector<RidgeSectionSource> voxel_sections(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::uint32_t blocks = esdf.layout.block_count();
  const std::size_t chunks = chunks_for(blocks);
  using Bytes = std::vector<std::byte>;
  return {{"state", kStateType, chunks,
           [&esdf, blocks](std::size_t chunk, Bytes& raw) {
             fill_states(esdf, blocks_of_chunk(chunk, blocks), raw);
           }},
          {"site", kSiteType, chunks,
           [&esdf, blocks](std::size_t chunk, Bytes& raw) {
             fill_sites(esdf, blocks_of_chunk(chunk, blocks), raw);
           }},
          {"diagram", kMaskType, chunks,
           [&roadmap, blocks](std::size_t chunk, Bytes& raw) {
             const VoxelMask& voxels = roadmap.diagram.voxels;
             const auto block_of = [&](std::uint32_t slot) {
               return std::as_bytes(std::span(voxels.block(slot)));
             };
             fill_plain(roadmap.esdf.layout, blocks_of_chunk(chunk, blocks), block_of, raw);
           }},
          {"attach", kAttachType, chunks, [&roadmap, blocks](std::size_t chunk, Bytes& raw) {
             const VoxelField<Direction>& next = roadmap.attach.next;
             const auto block_of = [&](std::uint32_t slot) {
               return std::as_bytes(std::span(next.block(slot), kBlockVoxels));
             };
             fill_plain(roadmap.esdf.layout, blocks_of_chunk(chunk, blocks), block_of, raw);
           }}};
}

}  // namespace ridgeway
