// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "mapping/memory_limit.hpp"
#include "ridge_sections.hpp"
#include "ridgeway/common/parallel.hpp"
#include "site_codec.hpp"
#include "voxel/mask_sets.hpp"
#include "voxel_chunks.hpp"

namespace ridgeway {
namespace {

/// What a thread keeps from chunk to chunk.
struct Worker {
  RidgeReader::Scratch scratch;
  std::vector<std::byte> state, site, diagram, attach;
};

/// A chunk that must have a given number of bytes for each of its blocks.
void read_exactly(const RidgeReader& reader, const RidgeSectionEntry& section, std::size_t chunk,
                  std::size_t expected, Worker& worker, std::vector<std::byte>& raw) {
  if (section.chunks[chunk].raw_bytes != expected) {
    reader.damaged(section.name, "has a chunk of the wrong size");
  }
  reader.read_chunk(section, chunk, worker.scratch, raw);
}

/// Widens one block's part of a plane of bytes or words.
void load_plane(const std::byte* raw, bool narrow, BlockPlane& plane) {
  if (!narrow) {
    std::memcpy(plane.data(), raw, sizeof(plane));
    return;
  }
  std::array<std::int8_t, kBlockVoxels> bytes;
  std::memcpy(bytes.data(), raw, sizeof(bytes));
  std::copy(bytes.begin(), bytes.end(), plane.begin());
}

/// States, obstacle bits and which voxels have a site to come; false where a byte makes no sense.
bool decode_states(const std::byte* raw, EsdfMap& esdf, std::uint32_t slot, BlockPlane& live) {
  std::array<std::uint8_t, kBlockVoxels> obstacle;
  VoxelState* state = esdf.state.block(slot);
  unsigned obstacles = 0;  // by state
  for (const VoxelState kind : {VoxelState::kUnknown, VoxelState::kFree, VoxelState::kOccupied})
    obstacles |= static_cast<unsigned>(is_obstacle(kind, esdf.unknown))
                 << static_cast<unsigned>(kind);
  unsigned bad = 0;
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    const auto byte = static_cast<unsigned>(raw[i]);
    const unsigned value = byte & 3, no_site = byte >> 2 & 1;
    const unsigned solid = obstacles >> value & 1;
    bad |= byte >> 3 | (value & (value >> 1)) | (solid & no_site);
    state[i] = static_cast<VoxelState>(value);
    obstacle[i] = static_cast<std::uint8_t>(solid);
    live[i] = static_cast<std::int16_t>(-static_cast<int>((solid ^ 1) & (no_site ^ 1)));
  }
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    std::uint64_t layer = 0;
    for (std::size_t y = 0; y < kBlockSide; ++y) {
      std::uint64_t row = 0;  // eight bytes of 0 or 1 become eight bits
      std::memcpy(&row, obstacle.data() + z * 64 + y * 8, 8);
      layer |= (row * 0x0102040810204080ull >> 56) << (8 * y);
    }
    esdf.obstacle.block(slot)[z] = layer;
  }
  return bad == 0;
}

/// Distances to sites; false where an offset is zero or longer than any distance may be.
bool decode_distances(const SitePlanes& sites, const BlockPlane& live, EsdfMap& esdf,
                      std::uint32_t slot) {
  std::uint32_t* squared = esdf.squared.block(slot);
  const VoxelMask::Block& obstacle = esdf.obstacle.block(slot);
  std::uint32_t bad = 0;
  const auto part = [&](int k) {
    bad |= static_cast<std::uint32_t>((k > kFarthestSite) | (k < -kFarthestSite));
    const int twice = 2 * (k < 0 ? -k : k);
    const std::uint32_t odd = static_cast<std::uint32_t>(twice - (twice != 0));
    return odd * odd;
  };
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    const std::uint32_t sum = part(sites.x[i]) + part(sites.y[i]) + part(sites.z[i]);
    bad |= static_cast<std::uint32_t>((live[i] != 0) & (sum == 0));
    squared[i] = sum | (live[i] != 0 ? 0u : kNoSite);
  }
  for (std::size_t z = 0; z < kBlockSide; ++z)
    for (std::uint64_t bits = obstacle[z]; bits != 0; bits &= bits - 1)
      squared[z * 64 + static_cast<std::size_t>(std::countr_zero(bits))] = 0;
  return bad == 0;
}

/// The sites themselves; false where one is too far for a field of such offsets.
template <typename Offset>
bool store_sites(const SitePlanes& sites, Offset* field) {
  int lost = 0;
  const auto part = [&](int k) {
    lost |= static_cast<int>((k > Offset::kFarthest) | (k < -Offset::kFarthest));
    return static_cast<decltype(Offset::x)>(k);
  };
  for (std::size_t i = 0; i < kBlockVoxels; ++i)
    field[i] = {part(sites.x[i]), part(sites.y[i]), part(sites.z[i])};
  return lost == 0;
}

/// False where `site` cannot hold what there is.
template <typename Offset>
bool load_esdf_blocks(const RidgeReader& reader, const BlockRange& range, const Worker& worker,
                      EsdfMap& esdf, VoxelField<Offset>& site) {
  bool all_stored = true;
  const std::size_t voxels = range.count() * kBlockVoxels;
  const bool narrow = worker.site.size() == 3 * voxels;
  const std::size_t width = narrow ? 1 : 2;
  SitePlanes coded, sites;
  BlockPlane live;
  for (std::uint32_t slot = range.first; slot < range.last; ++slot) {
    const std::size_t offset = std::size_t{slot - range.first} * kBlockVoxels;
    if (!decode_states(worker.state.data() + offset, esdf, slot, live)) {
      reader.damaged("state", "has a voxel in no known state");
    }
    const VoxelMask::Block& solid = esdf.obstacle.block(slot);
    if (std::all_of(solid.begin(), solid.end(), [](std::uint64_t l) { return l == ~0ull; })) {
      continue;  // all zero, as the fields were made
    }
    const std::byte* raw = worker.site.data() + offset * width;
    load_plane(raw, narrow, coded.x);
    load_plane(raw + voxels * width, narrow, coded.y);
    load_plane(raw + 2 * voxels * width, narrow, coded.z);
    decode_sites(coded, live, sites);
    if (!decode_distances(sites, live, esdf, slot)) {
      reader.damaged("site", "has an offset that no voxel can have");
    }
    all_stored = store_sites(sites, site.block(slot)) && all_stored;
  }
  return all_stored;
}

void load_diagram_blocks(const RidgeReader& reader, const BlockRange& range, const Worker& worker,
                         Roadmap& roadmap) {
  const VoxelMask& obstacle = roadmap.esdf.obstacle;
  std::uint64_t inside = 0;
  for (std::uint32_t slot = range.first; slot < range.last; ++slot) {
    VoxelMask::Block block;
    std::memcpy(&block, worker.diagram.data() + (slot - range.first) * sizeof(block),
                sizeof(block));
    for (std::size_t z = 0; z < kBlockSide; ++z) inside |= block[z] & obstacle.block(slot)[z];
    if (!detail::is_empty(block)) roadmap.diagram.voxels.block(slot) = block;
  }
  if (inside != 0) reader.damaged("diagram", "has a voxel inside an obstacle");
}

/// Whether sections of a type have a value for every voxel, and are inflated piece by piece.
bool has_voxels(std::uint32_t type) {
  return type == kStateType || type == kSiteType || type == kMaskType || type == kAttachType;
}

/// The fields take their pages from the system here, which costs as much as the decoding.
template <typename Offset>
void allocate_fields(Roadmap& roadmap, VoxelField<Offset>& site) {
  EsdfMap& esdf = roadmap.esdf;
  const BlockLayout& layout = esdf.layout;
  tbb::parallel_invoke(
      [&] {
        esdf.squared = VoxelField<std::uint32_t>(layout, 0, Pages::kLarge);
        esdf.state = VoxelField<VoxelState>(layout);
        esdf.obstacle = VoxelMask(layout);
      },
      [&] { site = VoxelField<Offset>(layout); },
      [&] {
        roadmap.attach.next = VoxelField<Direction>(layout);
        roadmap.diagram.voxels = VoxelMask(layout);
      });
  detail::stop_if_cancelled();
}

/// The sections with a value for every voxel.
struct VoxelSections {
  const RidgeSectionEntry& state;
  const RidgeSectionEntry& site;
  const RidgeSectionEntry& diagram;
  const RidgeSectionEntry& attach;
};

void load_chunk_of_diagram(const RidgeReader& reader, const VoxelSections& from, std::size_t chunk,
                           const BlockRange& range, Worker& worker, Roadmap& roadmap) {
  const std::size_t voxels = range.count() * kBlockVoxels;
  read_exactly(reader, from.diagram, chunk, voxels / 8, worker, worker.diagram);
  load_diagram_blocks(reader, range, worker, roadmap);
  read_exactly(reader, from.attach, chunk, voxels, worker, worker.attach);
  std::memcpy(roadmap.attach.next.block(range.first), worker.attach.data(), voxels);
  const auto last = *std::max_element(worker.attach.begin(), worker.attach.end());
  if (last > std::byte{AttachField::kNotTraversable}) {
    reader.damaged("attach", "has a direction above 27");
  }
}

/// With the sites as such offsets; false where one of them is too far for that.
template <typename Offset>
bool load_with(const RidgeReader& reader, const VoxelSections& from, std::uint32_t blocks,
               Roadmap& roadmap) {
  VoxelField<Offset> sites;
  allocate_fields(roadmap, sites);
  tbb::enumerable_thread_specific<Worker> workers;
  std::atomic<bool> is_too_far = false;
  parallel_for_each_index(from.site.chunks.size(), [&](std::size_t chunk) {
    if (is_too_far.load(std::memory_order_relaxed)) return;
    Worker& worker = workers.local();
    const BlockRange range = blocks_of_chunk(chunk, blocks);
    const std::size_t voxels = range.count() * kBlockVoxels;
    read_exactly(reader, from.state, chunk, voxels, worker, worker.state);
    const bool narrow = from.site.chunks[chunk].raw_bytes == 3 * voxels;
    read_exactly(reader, from.site, chunk, (narrow ? 3 : 6) * voxels, worker, worker.site);
    if (!load_esdf_blocks(reader, range, worker, roadmap.esdf, sites)) is_too_far = true;
    load_chunk_of_diagram(reader, from, chunk, range, worker, roadmap);
  });
  if (!is_too_far) roadmap.esdf.site = SiteField(std::move(sites));
  return !is_too_far;
}

/// Throws InputError where memory would not do for all of a file, with sites as such offsets.
template <typename Offset>
void require_memory_for(const RidgeReader& reader, const RidgeHeader& header) {
  constexpr double kBytesPerVoxel = 8 + sizeof(Offset);  // the fields, and the layout's share
  // A list is inflated whole, and what is made of it takes up to three times as much.
  constexpr int kBytesPerListed = 4;
  double listed = 0.0;
  for (const RidgeSectionEntry& section : reader.sections())
    if (!has_voxels(section.type)) listed += static_cast<double>(section.raw_bytes);
  require_memory(
      static_cast<double>(header.blocks) * kBlockVoxels * kBytesPerVoxel + kBytesPerListed * listed,
      reader.path(), "use a machine with more, or a coarser map");
}

}  // namespace

void check_memory(const RidgeReader& reader, const RidgeHeader& header) {
  require_memory_for<NearSiteOffset>(reader, header);
}

void load_voxels(const RidgeReader& reader, const RidgeHeader& header, Roadmap& roadmap) {
  const VoxelSections from{
      reader.get_section("state", kStateType), reader.get_section("site", kSiteType),
      reader.get_section("diagram", kMaskType), reader.get_section("attach", kAttachType)};
  const std::size_t chunks = chunks_for(header.blocks);
  for (const RidgeSectionEntry* section : {&from.state, &from.site, &from.diagram, &from.attach}) {
    if (section->chunks.size() != chunks) {
      reader.damaged(section->name, "does not fit the number of blocks");
    }
  }
  if (load_with<NearSiteOffset>(reader, from, header.blocks, roadmap)) return;
  roadmap.esdf.squared = {};  // makes room
  roadmap.esdf.state = {};
  roadmap.attach.next = {};
  require_memory_for<SiteOffset>(reader, header);
  load_with<SiteOffset>(reader, from, header.blocks, roadmap);
}

}  // namespace ridgeway
