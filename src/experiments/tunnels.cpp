// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tunnels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "common/random.hpp"
#include "common/require.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

constexpr double kSpacing = 60.0;      // metres between places of the lattice, along x and y,
constexpr double kLevelHeight = 25.0;  // and between levels
constexpr int kLevels = 3;
constexpr double kJitter = 12.0;     // metres, of a place along each axis; half of it along z
constexpr double kWayRound = 0.25;   // how often a gallery leads to a place that is reached already
constexpr double kBumpSize = 0.8;    // metres between bumps of the rock
constexpr double kRockVoxels = 2.0;  // thickness of what is seen of it
constexpr double kPieceLength = 8.0;  // metres, so that few blocks are near a piece in vain

/// A straight piece of a gallery, in voxels.
struct Piece {
  Point from, to;
  double radius;
};

/// Places of the lattice, grown from one along random galleries.
class Mine {
 public:
  explicit Mine(const TunnelConfig& config) : config_(config), random_(config.seed) {}

  std::vector<Piece> dig() {
    const double galleries = config_.length / kSpacing;
    side_ = 2 + static_cast<int>(std::ceil(std::sqrt(galleries / kLevels)));
    const VoxelIndex first{0, 0, 0};
    reached_.insert(first);
    reach(first);
    while (length_ < config_.length && !ends_.empty()) {
      const std::size_t pick = random_.below(ends_.size());
      const auto [from, to] = ends_[pick];
      ends_[pick] = ends_.back();
      ends_.pop_back();
      const bool is_new = reached_.insert(to).second;
      if (!is_new && random_.uniform() >= kWayRound) continue;
      add_gallery(from, to);
      if (is_new) reach(to);
    }
    return std::move(pieces_);
  }

 private:
  static constexpr std::array<VoxelIndex, 6> kWays = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

  bool is_place(const VoxelIndex& v) const {
    return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < side_ && v.y < side_ && v.z < kLevels;
  }

  void reach(const VoxelIndex& from) {
    for (const VoxelIndex& way : kWays)
      if (const VoxelIndex to = from + way; is_place(to)) ends_.emplace_back(from, to);
  }

  /// The same place whichever gallery asks.
  Point place_of(const VoxelIndex& v) const {
    Random random(config_.seed + 1, static_cast<std::uint64_t>(v.x + side_ * (v.y + side_ * v.z)));
    const double x = kSpacing * v.x + random.uniform(-kJitter, kJitter);
    const double y = kSpacing * v.y + random.uniform(-kJitter, kJitter);
    return {x, y, kLevelHeight * v.z + random.uniform(-0.5 * kJitter, 0.5 * kJitter)};
  }

  void add_gallery(const VoxelIndex& from, const VoxelIndex& to) {
    const double radius = config_.radius * random_.uniform(2.0 / 3.0, 4.0 / 3.0);
    const double bend = 0.5 * kJitter;
    const Point a = place_of(from), b = place_of(to);
    // In an order of our own: that of arguments is the compiler's choice.
    const double aside_y = random_.uniform(-bend, bend);
    const double aside_x = random_.uniform(-bend, bend);
    const Point middle = 0.5 * (a + b) + Point(aside_x, aside_y, 0.0);
    add_pieces(a, middle, radius);
    add_pieces(middle, b, radius);
    length_ += (middle - a).norm() + (b - middle).norm();
  }

  void add_pieces(const Point& a, const Point& b, double radius) {
    const double voxel = config_.voxel_size;
    const int count = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kPieceLength)));
    for (int i = 0; i < count; ++i) {
      const double t = static_cast<double>(i) / count, u = static_cast<double>(i + 1) / count;
      pieces_.push_back({(a + t * (b - a)) / voxel, (a + u * (b - a)) / voxel, radius / voxel});
    }
  }

  const TunnelConfig& config_;
  Random random_;
  int side_ = 0;
  double length_ = 0.0;
  std::set<VoxelIndex> reached_;
  std::vector<std::pair<VoxelIndex, VoxelIndex>> ends_;  // galleries that could be dug
  std::vector<Piece> pieces_;
};

double distance_to(const Piece& piece, const Point& p) {
  const Point along = piece.to - piece.from;
  const double t = std::clamp((p - piece.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - piece.from - t * along).norm() - piece.radius;
}

/// How far rock stands out at a place, in [0, 1]: random at the corners of a lattice, smooth
/// between. `p` counts bumps.
double bump_at(const Point& p, std::uint64_t seed) {
  const Point floor = p.array().floor(), t = p - floor;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int up = (corner >> axis) & 1;
      weight *= up != 0 ? t[axis] : 1.0 - t[axis];
      key = (key << 21) ^
            (static_cast<std::uint64_t>(static_cast<std::int64_t>(floor[axis]) + up) & 0x1fffff);
    }
    sum += weight * Random(seed, key).uniform();
  }
  return sum;
}

/// Pieces by block: those that may reach into it, or whose rock may.
using PiecesOfBlocks = std::vector<std::pair<BlockIndex, std::uint32_t>>;

PiecesOfBlocks pieces_of_blocks(const std::vector<Piece>& pieces) {
  const double half_diagonal = 0.5 * std::sqrt(3.0) * kBlockSide;
  PiecesOfBlocks found;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const Point reach = Point::Constant(piece.radius + kRockVoxels);
    const Point low = piece.from.cwiseMin(piece.to) - reach;
    const Point high = piece.from.cwiseMax(piece.to) + reach;
    const BlockIndex first = block_of(voxel_at(low, 1.0)), last = block_of(voxel_at(high, 1.0));
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
          const Point centre = Point(x + 0.5, y + 0.5, z + 0.5) * kBlockSide;
          if (distance_to(piece, centre) < kRockVoxels + half_diagonal)
            found.push_back({{x, y, z}, i});
        }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

void TunnelConfig::validate() const {
  using detail::require;
  require(length > 0.0 && length <= 1e6, "length", length, "give metres above 0, at most 1e6");
  require(radius > 0.0 && radius <= 10.0, "radius", radius, "give metres above 0, at most 10");
  require(voxel_size > 1e-3 && voxel_size <= 0.2 * radius, "voxel_size", voxel_size,
          "give metres, at most a fifth of the radius");
  require(roughness >= 0.0 && roughness < radius / 3.0, "roughness", roughness,
          "give metres below a third of the radius");
}

OccupancyMap make_tunnels(const TunnelConfig& config) {
  config.validate();
  const double across = config.radius / config.voxel_size;
  require_memory(std::numbers::pi * across * across * (config.length / config.voxel_size) *
                     kPipelineBytesPerVoxel,
                 "the mine", "give a shorter one, or larger voxels");
  const std::vector<Piece> pieces = Mine(config).dig();
  const PiecesOfBlocks near = pieces_of_blocks(pieces);
  std::vector<BlockIndex> blocks;
  std::vector<std::size_t> first;  // of each block's pieces
  for (std::size_t i = 0; i < near.size(); ++i)
    if (blocks.empty() || blocks.back() != near[i].first) {
      blocks.push_back(near[i].first);
      first.push_back(i);
    }
  first.push_back(near.size());
  require_memory_for_blocks(static_cast<double>(blocks.size()), kPipelineBytesPerVoxel, "the mine");

  OccupancyMap map;
  map.voxel_size = config.voxel_size;
  map.layout = BlockLayout(std::move(blocks));
  map.state = VoxelField<VoxelState>(map.layout);
  const double roughness = config.roughness / config.voxel_size;
  const double bumps = config.voxel_size / kBumpSize;  // a voxel
  parallel_for_each_index(map.layout.block_count(), [&](std::size_t slot) {
    const auto id = static_cast<VoxelId>(slot * kBlockVoxels);
    for (VoxelId v = id; v < id + kBlockVoxels; ++v) {
      const Point p = centre_of(map.layout.index_of(v), 1.0);
      double off = std::numeric_limits<double>::infinity();  // beyond the smooth wall
      for (std::size_t i = first[slot]; i < first[slot + 1]; ++i)
        off = std::min(off, distance_to(pieces[near[i].second], p));
      if (off > -roughness && off < kRockVoxels && roughness > 0.0)
        off += roughness * bump_at(bumps * p, config.seed);
      if (off < kRockVoxels) map.state[v] = off < 0.0 ? VoxelState::kFree : VoxelState::kOccupied;
    }
  });
  return normalised(std::move(map));
}

}  // namespace ridgeway
