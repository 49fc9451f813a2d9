// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "cell_approach.hpp"
#include "cell_neighbours.hpp"
#include "cell_walks.hpp"
#include "met_cells.hpp"
#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// A way between two voxels over cells, for a robot of any radius: what guides a search over
/// voxels. Voxels of a cell that the robot fits on and that moves across faces connect are a part
/// of it; a part leads to those in the same and the 26 cells around that a free move leads to. So
/// no way over voxels is missing, however narrow.
class CellGuide {
 public:
  /// All must outlive it.
  CellGuide(const Roadmap& roadmap, const FreeSpace& space, double radius, VoxelId from,
            VoxelId to);

  /// A* from `to`, as nothing is known of ways to it yet. False where that finds no way in time.
  bool find_way(int most_parts, const Deadline& deadline);

  /// Of the way from a voxel to `to`, about, voxels; infinite where the search has met none.
  double rest_from(const VoxelIndex& voxel) const;

 private:
  using Place = Eigen::Vector3f;  // voxels
  using PartId = std::uint32_t;   // place in parts_
  static constexpr PartId kNoPart = 0xffffffffu;

  /// Voxels of a cell that the robot fits on and that moves across faces in there connect.
  struct Part {
    CellId cell;
    CellMask voxels;
    Place place;            ///< the middle of them, or the voxel that ways lead to
    PartId next = kNoPart;  ///< on the way to `to`; itself at its end
    float cost = std::numeric_limits<float>::infinity();  ///< of the way, voxels
    float rest = 0.0f;                                    ///< of the way from the start, about
    bool is_final = false;                                ///< ways go on from it: once only
  };
  struct Met {
    PartId first = kNoPart, last = kNoPart;  ///< its parts: from the first to before the last
  };
  struct Open {
    float estimate, cost;
    PartId part;
    bool operator<(const Open& other) const {  // the queue's top is the best
      return estimate != other.estimate ? estimate > other.estimate : part > other.part;
    }
  };

  PartId part_with(const VoxelIndex& voxel);
  const Met& parts_of(CellId cell);
  CellMask voxels_for_robot(CellId cell) const;
  void expand(PartId id);
  bool leads(const Part& from, const Part& to, int step) const;
  bool leads(const Part& from, const Part& to, int step, int move) const;
  float rest_of_search(CellId cell, const Place& place) const;

  const CellsForRobot around_;
  const CellGraph::Lengths& lengths_;
  const VoxelIndex start_, end_;  // of ways; the search goes from the end to the start
  std::array<float, CellGraph::kLandmarks> start_lengths_{};
  MetCells<Met> met_;
  std::vector<Part> parts_;
  std::priority_queue<Open> open_;
};

}  // namespace ridgeway::detail
