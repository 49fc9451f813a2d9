// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// A place to look from: the centre of a traversable voxel, the map's own.
struct Place {
  std::uint64_t id = 0;  ///< never that of another place
  VoxelIndex voxel;
  Point position = Point::Zero();  ///< local frame
};

/// At most one place in each cube of a side: on the diagram, where it is widest. A place stays as
/// long as it is traversable and nothing in its cube is far wider, so that what was found out about
/// it holds on.
class DiagramPlaces {
 public:
  explicit DiagramPlaces(double spacing) : spacing_(spacing) {}
  void update(const Roadmap& roadmap);
  const std::vector<Place>& places() const { return places_; }  ///< by cube

 private:
  double spacing_;
  VoxelIndex origin_{};
  std::map<BlockIndex, Place> of_cube_;
  std::vector<Place> places_;
  std::uint64_t next_id_ = 1;
};

/// The widest traversable voxel of each such cube, on the diagram or not.
std::vector<Place> widest_places(const Roadmap& roadmap, double spacing);

}  // namespace ridgeway::detail
