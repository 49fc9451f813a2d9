// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "attach_way.hpp"

#include <algorithm>
#include <cmath>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {
namespace {

/// How far from a voxel every place has at least a clearance, voxels: distances differ by no more
/// than places are apart.
double beyond_reach(std::uint32_t squared, SquaredHalves clearance) {
  constexpr double kRounding = 1e-6;
  if (squared == kNoSite) return 0.0;  // how far it is from obstacles is not known
  return 0.5 * (std::sqrt(static_cast<double>(squared)) - std::sqrt(clearance.value)) - kRounding;
}

/// Goes along the way of a voxel.
class AttachFollower {
 public:
  AttachFollower(const Roadmap& roadmap, VoxelId from, double radius)
      : roadmap_(roadmap),
        esdf_(roadmap.esdf),
        space_(roadmap.esdf),
        threshold_(least_clearance(radius, roadmap.esdf.voxel_size)),
        at_(from) {}

  /// To the next voxel; false once the way has stopped.
  bool step() {
    if (has_stopped_) return false;
    way_.voxels.push_back(at_);
    way_.met_diagram |= roadmap_.diagram.voxels.test(at_);
    const Direction next = roadmap_.attach.next[at_];
    if (next == AttachField::kHere)
      way_.vertex = vertex_at(roadmap_.graph, esdf_.layout.index_of(at_));
    has_stopped_ = next == AttachField::kHere || next == AttachField::kNotTraversable;
    if (has_stopped_) return false;
    const VoxelId to = esdf_.layout.neighbour(at_, next);
    has_stopped_ = to == kNoVoxel || !measure(to, next);
    at_ = to;
    return !has_stopped_;
  }

  AttachWay way() const {
    AttachWay way = way_;
    way.clearance = narrowest_.metres(esdf_.voxel_size);
    return way;
  }

 private:
  /// The move to the next voxel; false where the robot does not pass. Ways lead away from
  /// obstacles: mostly the first moves are the narrowest.
  bool measure(VoxelId to, Direction direction) {
    const double length = std::sqrt(static_cast<double>(squared_length(direction)));
    if (sure_ < length) {
      if (FreeSpace::move_bound(esdf_.squared[at_], esdf_.squared[to], squared_length(direction)) <
          narrowest_) {
        const SquaredHalves clearance = space_.move_clearance(at_, to, direction);
        if (clearance < threshold_) return false;
        narrowest_ = std::min(narrowest_, clearance);
      }
      sure_ = length + beyond_reach(esdf_.squared[to], narrowest_);
    }
    sure_ -= length;
    return true;
  }

  const Roadmap& roadmap_;
  const EsdfMap& esdf_;
  const FreeSpace space_;
  const SquaredHalves threshold_;
  AttachWay way_;
  VoxelId at_;
  SquaredHalves narrowest_{std::numeric_limits<double>::infinity()};
  double sure_ = 0.0;  ///< voxels that the way may go on before a move can be narrower than that
  bool has_stopped_ = false;
};

}  // namespace

VertexId vertex_at(const SparseGraph& graph, const VoxelIndex& voxel) {
  // Vertices are in the order of their voxels: by block, then by place in the block.
  const auto key = [](const VoxelIndex& v) { return std::pair(block_of(v), local_of(v)); };
  const auto place =
      std::lower_bound(graph.vertices.begin(), graph.vertices.end(), voxel,
                       [&](const Vertex& a, const VoxelIndex& b) { return key(a.voxel) < key(b); });
  if (place == graph.vertices.end() || place->voxel != voxel) return kNoVertex;
  return VertexId{static_cast<std::uint32_t>(place - graph.vertices.begin())};
}

AttachWay follow_attach(const Roadmap& roadmap, VoxelId from, double radius) {
  AttachFollower follower(roadmap, from, radius);
  while (follower.step()) {
  }
  return follower.way();
}

std::array<AttachWay, 2> follow_attach(const Roadmap& roadmap, const std::array<VoxelId, 2>& from,
                                       double radius) {
  // A step waits for memory: those of the two ways wait together.
  AttachFollower one(roadmap, from[0], radius), other(roadmap, from[1], radius);
  for (bool goes_on = true; goes_on;) {
    goes_on = one.step();
    goes_on |= other.step();
  }
  return {one.way(), other.way()};
}

}  // namespace ridgeway::detail
