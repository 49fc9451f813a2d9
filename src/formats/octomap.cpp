// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "octomap.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "common/number_text.hpp"
#include "files/byte_reader.hpp"
#include "files/text.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";
constexpr std::string_view kLegacyMagic{"\3\0\0\0", 4};  // tree type 3, then resolution and size
constexpr int kDepth = 16;                               // levels below the root
constexpr int kHalfSide = 1 << (kDepth - 1);             // key 32768 is voxel 0
constexpr const char* kFetchAgain = "the file is damaged, fetch or write it again";

/// A leaf or a subtree: a cube of 2^k voxels a side.
struct Cube {
  VoxelIndex min = {-kHalfSide, -kHalfSide, -kHalfSide};
  int side = 2 * kHalfSide;

  Cube child(int i) const {
    const int half = side / 2;
    return {{min.x + (i & 1) * half, min.y + (i >> 1 & 1) * half, min.z + (i >> 2 & 1) * half},
            half};
  }
  VoxelRange voxels() const {
    return {min, {min.x + side - 1, min.y + side - 1, min.z + side - 1}};
  }
};

/// Walks the nodes in the file's order and hands every leaf to `leaf(cube, state)`. Recursion ends
/// at cubes of one voxel, whatever the file says.
template <typename Leaf>
class TreeWalk {
 public:
  TreeWalk(ByteReader& reader, const OctomapHeader& header, Leaf leaf)
      : reader_(reader), header_(header), leaf_(std::move(leaf)) {}

  std::uint64_t run() {
    nodes_ = 1;
    header_.binary ? binary_children(Cube{}) : full_node(Cube{});
    return nodes_;
  }

 private:
  /// .bt: an inner node is 16 bits, two a child: 0 unknown, 1 free, 2 occupied, 3 inner.
  void binary_children(const Cube& cube) {
    if (cube.side == 1) reader_.fail("has a node below the 16th level", kFetchAgain);
    const auto low = reader_.take<std::uint8_t>();
    const auto high = reader_.take<std::uint8_t>();
    const unsigned kinds = low | static_cast<unsigned>(high) << 8;
    if (kinds == 0) reader_.fail("has an inner node without children", kFetchAgain);
    const unsigned known = (kinds | kinds >> 1) & 0x5555, inner = kinds & kinds >> 1 & 0x5555;
    nodes_ += static_cast<unsigned>(std::popcount(known));
    for (unsigned leaves = known & ~inner; leaves != 0; leaves &= leaves - 1) {
      const int bit = std::countr_zero(leaves);
      leaf_(cube.child(bit / 2), kinds >> bit & 1 ? VoxelState::kFree : VoxelState::kOccupied);
    }
    for (unsigned rest = inner; rest != 0; rest &= rest - 1)
      binary_children(cube.child(std::countr_zero(rest) / 2));
  }

  /// .ot: a node is its log-odds, perhaps a colour, and a bit for each child that follows.
  void full_node(const Cube& cube) {
    const auto log_odds = reader_.take<float>();
    reader_.skip(static_cast<std::size_t>(header_.colour_bytes));
    const auto children = reader_.take<std::uint8_t>();
    if (children == 0) {
      if (std::isnan(log_odds))
        reader_.fail("has a leaf whose log-odds are no number", kFetchAgain);
      leaf_(cube, log_odds >= 0.0f ? VoxelState::kOccupied : VoxelState::kFree);
      return;
    }
    if (cube.side == 1) reader_.fail("has a node below the 16th level", kFetchAgain);
    for (int i = 0; i < 8; ++i) {
      if ((children >> i & 1) == 0) continue;
      ++nodes_;
      full_node(cube.child(i));
    }
  }

  ByteReader& reader_;
  const OctomapHeader& header_;
  Leaf leaf_;
  std::uint64_t nodes_ = 0;
};

template <typename Leaf>
std::uint64_t walk_tree(ByteReader& reader, const OctomapHeader& header, Leaf leaf) {
  return TreeWalk<Leaf>(reader, header, std::move(leaf)).run();
}

VoxelRange hull(const VoxelRange& a, const VoxelRange& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

/// The box around all voxels of a sound file, as placed, for messages.
std::string describe_span(std::string_view bytes, const std::string& name,
                          const OctomapHeader& header, const VoxelPlacement& placement) {
  VoxelRange range = {kAllVoxels.max, kAllVoxels.min};
  ByteReader reader(bytes, name, header.data_offset);
  walk_tree(reader, header, [&](const Cube& cube, VoxelState) {
    range = hull(range, placement.motion(cube.voxels()));
  });
  const double s = header.voxel_size;
  std::ostringstream text;
  text << std::setprecision(12) << range.min.x * s << ',' << range.min.y * s << ','
       << range.min.z * s << " to " << (range.max.x + 1) * s << ',' << (range.max.y + 1) * s << ','
       << (range.max.z + 1) * s;
  return text.str();
}

/// Reads the whole file once without keeping anything: is it sound, and how many blocks will the
/// map have (a little fewer than it will, where the motion shifts cubes off the blocks)?
double check_tree(std::string_view bytes, const std::string& name, const OctomapHeader& header,
                  const VoxelPlacement& placement) {
  ByteReader reader(bytes, name, header.data_offset);
  if (header.nodes == 0) reader.fail("holds no voxels", "record a map first");
  double blocks = 0.0;
  bool any_free = false;
  std::optional<BlockIndex> last;
  const std::uint64_t nodes = walk_tree(reader, header, [&](const Cube& cube, VoxelState state) {
    any_free |= state == VoxelState::kFree;
    if (cube.side >= kBlockSide) {
      const VoxelRange moved = placement.motion(cube.voxels());
      if (placement.clip == kAllVoxels) require_within_reach(moved, name);
      const VoxelRange kept = intersection(moved, placement.clip);
      if (kept.empty()) return;
      blocks += (kept.max.x - kept.min.x + 1.0) * (kept.max.y - kept.min.y + 1.0) *
                (kept.max.z - kept.min.z + 1.0) / kBlockVoxels;
    } else if (const BlockIndex block = block_of(cube.min); last != block) {
      last = block;  // the file's order keeps the leaves of a block together
      const VoxelRange whole = {voxel_of(block, 0), voxel_of(block, kBlockVoxels - 1)};
      // Where nothing is clipped away, the builder refuses single voxels that are out of reach.
      if (placement.clip == kAllVoxels ||
          !intersection(placement.motion(whole), placement.clip).empty())
        blocks += 1.0;
    }
  });
  if (reader.remaining() > 0) {
    reader.fail("goes on for " + std::to_string(reader.remaining()) + " bytes after its last node",
                kFetchAgain);
  }
  if (nodes != header.nodes) {
    reader.fail("has " + std::to_string(nodes) + " nodes where its header says " +
                    std::to_string(header.nodes),
                kFetchAgain);
  }
  if (!any_free) {
    reader.fail("has no free space, so there is nowhere to fly",
                "record the map with free space (OctoMap's insertPointCloud does)");
  }
  if (blocks == 0.0) {
    throw InputError(name, "has no voxel within the bounds",
                     "its voxels span " + describe_span(bytes, name, header, placement));
  }
  return blocks;
}

void check_resolution(const ByteReader& reader, double resolution) {
  if (resolution >= 1e-6 && resolution <= 1e6) return;
  reader.fail("has a resolution of " + number_text(resolution) + " m",
              "it must lie between 1e-6 and 1e6 m");
}

OctomapHeader read_legacy_header(ByteReader& reader) {
  OctomapHeader header{.binary = true};
  reader.skip(kLegacyMagic.size());
  header.voxel_size = reader.take<double>();
  check_resolution(reader, header.voxel_size);
  header.nodes = reader.take<std::uint32_t>();
  header.data_offset = reader.offset();
  return header;
}

void check_id(const ByteReader& reader, OctomapHeader& header, std::string_view id) {
  if (id.empty()) reader.fail("names no tree type (id)", kFetchAgain);
  if (header.binary ? id == "OcTree" || id == "ColorOcTree" || id == "OcTreeStamped"
                    : id == "OcTree" || id == "OcTreeStamped")
    return;
  if (id == "ColorOcTree") {
    header.colour_bytes = 3;
    return;
  }
  reader.fail("holds a tree of type '" + std::string(id.substr(0, 40)) + "'",
              "OcTree, ColorOcTree and OcTreeStamped can be read; convert it to one of them");
}

}  // namespace

bool is_octomap(std::string_view bytes) {
  return bytes.starts_with(kBinaryMagic) || bytes.starts_with(kFullMagic) ||
         (bytes.starts_with(kLegacyMagic) && bytes.size() >= 16);
}

OctomapHeader read_octomap_header(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  if (bytes.starts_with(kLegacyMagic)) return read_legacy_header(reader);

  OctomapHeader header{.binary = bytes.starts_with(kBinaryMagic)};
  std::string_view id;
  std::optional<double> resolution;
  std::optional<std::uint64_t> nodes;
  while (true) {
    std::string_view line = reader.take_line();
    const std::string_view key = take_word(line), value = take_word(line);
    if (key == "data") break;
    if (key == "id") id = value;
    if (key == "res") resolution = to_number<double>(value);
    if (key == "size") nodes = to_number<std::uint64_t>(value);
  }
  check_id(reader, header, id);
  if (!resolution) reader.fail("gives no resolution (res) in its header", kFetchAgain);
  if (!nodes) reader.fail("gives no number of nodes (size) in its header", kFetchAgain);
  check_resolution(reader, *resolution);
  header.voxel_size = *resolution;
  header.nodes = *nodes;
  header.data_offset = reader.offset();
  return header;
}

OccupancyMap read_octomap(std::string_view bytes, const std::string& name,
                          const VoxelPlacement& placement) {
  const OctomapHeader header = read_octomap_header(bytes, name);
  const double blocks = check_tree(bytes, name, header, placement);
  require_memory_for_blocks(blocks, placement.bytes_per_voxel, name);

  OccupancyBuilder builder(
      header.voxel_size,
      {.clip = placement.clip, .bytes_per_voxel = placement.bytes_per_voxel, .name = name});
  ByteReader reader(bytes, name, header.data_offset);
  const bool is_moved = placement.motion != LatticeTransform{};
  walk_tree(reader, header, [&](const Cube& cube, VoxelState state) {
    const VoxelRange voxels = is_moved ? placement.motion(cube.voxels()) : cube.voxels();
    cube.side == 1 ? builder.set(voxels.min, state) : builder.fill(voxels, state);
  });
  return std::move(builder).finish();
}

}  // namespace ridgeway
