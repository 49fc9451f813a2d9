// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "esdf/remembered_space.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// Number of a voxel among the diagram's voxels, in the order of voxels.
using DiagramNumber = std::uint32_t;
inline constexpr DiagramNumber kNowhere = 0xffffffffu;

/// A legal move between two diagram voxels.
struct DiagramMove {
  DiagramNumber to;
  float length;  ///< voxels
  SquaredHalves clearance;
};

/// The diagram as a compact graph of its voxels and their legal moves: everything the sparse
/// graph is made from, in a few cache lines a voxel.
struct DiagramCurves {
  const BlockLayout* layout = nullptr;        ///< of the map
  double voxel_size = 0.0;                    ///< metres
  std::vector<VoxelId> voxels;                ///< in the layout's order
  std::vector<std::uint32_t> first_of_block;  ///< by the block's place in that order, of `voxels`
  std::vector<std::uint32_t> squared;         ///< as in EsdfMap
  std::vector<std::uint32_t> first_move;      ///< voxels.size() + 1 entries into `moves`
  std::vector<DiagramMove> moves;

  std::size_t size() const { return voxels.size(); }
  std::span<const DiagramMove> moves_of(DiagramNumber v) const {
    return std::span(moves).subspan(first_move[v], first_move[v + 1] - first_move[v]);
  }
  /// Centre of a voxel, metres.
  Point position(DiagramNumber v) const {
    return centre_of(layout->index_of(voxels[v]), voxel_size);
  }
  /// Number of a diagram voxel; kNowhere for any other.
  DiagramNumber find(VoxelId id) const;
};

/// `memory`: of segments, where the map is one that changes.
DiagramCurves index_diagram(const EsdfMap& esdf, const VoxelMask& diagram, double min_clearance,
                            SegmentMemory* memory = nullptr);

/// For every diagram voxel the widest way along the diagram to one of the given vertices, the
/// shortest among equally wide ones.
struct DiagramFlood {
  std::vector<std::uint32_t> vertex;  ///< index into the given vertices; kNowhere: not reached
  std::vector<DiagramNumber> toward;  ///< next voxel; itself at a vertex
  std::vector<SquaredHalves> width;   ///< clearance of the way
  std::vector<float> distance;        ///< voxels
};
DiagramFlood flood_from(const DiagramCurves& curves, std::span<const DiagramNumber> vertices);

}  // namespace ridgeway::detail
