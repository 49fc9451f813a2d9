// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// What is in the way.
enum class Blocker : std::uint8_t {
  kObstacle,  ///< something occupied
  kUnknown,   ///< space that may be free, for all that is known
  kLimits,    ///< limits of the flight alone: without them there is a way at the radius
};
/// "obstacle", "unknown" or "limits".
std::string_view name_of(Blocker blocker);

/// A connected part of traversable space.
struct Component {
  std::size_t voxels = 0;  ///< that are traversable
  double volume = 0.0;     ///< cubic metres
  Point widest;            ///< its place of largest clearance, world
  double clearance = 0.0;  ///< there, metres
};

/// The largest radius, below the one asked for, at which two components would be one, and the place
/// that is too narrow. `a` and `b` index the components; the joins form a forest.
struct ComponentJoin {
  std::size_t a = 0;                ///< index of one component
  std::size_t b = 0;                ///< index of another
  double radius = 0.0;              ///< metres
  Point place;                      ///< world
  Blocker by = Blocker::kObstacle;  ///< what is nearest there; of equally near ones the obstacle
};

/// The parts of space that hang together, and where a smaller robot finds two of them one.
struct ComponentReport {
  std::vector<Component> components;  ///< largest first
  std::vector<ComponentJoin> joins;   ///< widest first
  std::vector<std::size_t> asked;     ///< the components that voxels asked about lie in
};

/// Which parts of free space hang together at which radius, exact over all legal moves. Made in
/// about the time of the kernel's stage; then it answers for every radius above a quarter of a
/// voxel. A view: the EsdfMap must outlive it. Thread-safe.
class SpaceParts {
 public:
  /// `within_limits`: of the flights on the map, if it has some; else as if it had none.
  explicit SpaceParts(const EsdfMap& esdf, bool within_limits = true);
  explicit SpaceParts(const EsdfMap&&, bool = true) = delete;

  /// Parts of the voxels that are traversable at a radius, and where a smaller robot would find
  /// them joined. `asked`: traversable voxels whose parts are wanted.
  ComponentReport report(double radius, const std::vector<VoxelId>& asked = {}) const;

  /// The same without the joins, which take most of the time where there are many parts.
  ComponentReport parts(double radius, const std::vector<VoxelId>& asked = {}) const;

  /// The narrowest move of the widest way between two free voxels; nothing where no way joins them
  /// at any radius, or both are one.
  std::optional<Pass> narrowest_move(VoxelId a, VoxelId b) const;

  /// Where on a move it is narrowest, world, and what is nearest there.
  struct Narrow {
    Point place;                      ///< metres, world
    Blocker by = Blocker::kObstacle;  ///< of equally near ones the obstacle
  };
  /// Of a move between two voxels of the map; see narrowest_move.
  Narrow look_at(const Pass& pass) const;

 private:
  const EsdfMap& esdf_;
  const bool within_limits_;
  Surroundings around_;
  Basins basins_;
};

/// Parts of traversable space at the roadmap's min_clearance, and how a smaller robot would find
/// them joined. Takes about as long as the kernel's stage.
ComponentReport report_components(const Roadmap& roadmap);

}  // namespace ridgeway
