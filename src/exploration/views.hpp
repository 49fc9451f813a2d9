// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "ridgeway/exploration/explorer.hpp"
#include "viewpoints.hpp"

namespace ridgeway::detail {

/// A box around points.
struct Bounds {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = Point::Constant(-std::numeric_limits<double>::infinity());

  bool is_empty() const { return low.x() > high.x(); }
  void add(const Point& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool meets(const Bounds& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// A target of a part as seen from a place.
struct Ray {
  std::uint32_t headings = 0;  ///< a bit for each heading at which it is in view
  std::uint8_t target = 0;     ///< which of the part's sampled targets, at most 64
  float weight = 0.0f;         ///< voxels of the part that it stands for
};

/// What is seen of a part from a place.
struct Sight {
  std::size_t part = 0;
  std::span<const Ray> rays;
  double worth = 1.0;  ///< unknown voxels behind each voxel of the part
};

/// A place with a heading, and what is to be seen from there.
struct Stop {
  std::size_t place = 0;
  int heading = 0;
  double gain = 0.0;  ///< unknown voxels that no stop before has in view, about
};

/// Which frontiers are seen from which places: rays are cast when they are first asked for, and
/// again where the map has changed between a place and a part.
class Views {
 public:
  /// `within`: voxels of the lattice that are to be seen. `deepest`: metres of unknown space behind
  /// a frontier that count at most; 0: frontiers count by their voxels alone.
  Views(const FieldOfView& view, int headings, const VoxelRange& within, double deepest);

  /// Looks at the parts of clusters with `least` voxels or more from the nearest places, and from
  /// farther ones where none of these sees a part; at parts near to a point first, with no more
  /// than so many rays: what is left over comes next time. With kAllRays at all targets from all
  /// places.
  static constexpr std::size_t kAllRays = std::numeric_limits<std::size_t>::max();
  void update(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
              std::span<const Place> places, const Point& near, std::size_t most_rays);

  /// To be called after every update of the frontiers.
  void note_changes(const Roadmap& roadmap, const Frontiers& frontiers);

  /// As gain_at() with nothing covered, by rays cast now.
  double gain_now(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
                  const Place& place, int heading) const;

  /// By place: what is seen from it.
  const std::vector<std::vector<Sight>>& from_places() const { return from_places_; }

  /// From a place nothing more is expected of a part as it is now.
  void ban(const Place& place, const FrontierPart& part);

  /// Unknown voxels in view at a place's best heading, or at a given one, where `covered` has a bit
  /// for each target of a part that does not count. About: the voxels of frontiers in view, times
  /// how deep the unknown behind them is.
  Stop best_heading(std::size_t place, std::span<const std::uint64_t> covered) const;
  double gain_at(std::size_t place, int heading, std::span<const std::uint64_t> covered) const;
  void cover(std::size_t place, int heading, std::span<std::uint64_t> covered) const;

  /// Headings, as bits, at which the way from a place to a target would be in view.
  std::uint32_t headings_to(const Point& from, const Point& target) const;
  double yaw_of(int heading) const;
  int heading_of(double yaw) const;
  std::size_t parts() const { return part_count_; }

 private:
  struct Cached {
    std::vector<Ray> rays;
    bool all_seen = false;
  };
  struct PartViews {
    std::uint64_t version = 0;
    bool thorough = false;
    bool is_live = false;
    std::unordered_map<std::uint64_t, Cached> from;  ///< by id of the place
  };

  void forget_changed(const Roadmap& roadmap, std::span<const Place> places);
  const Cached* look(const Roadmap& roadmap, const FrontierPart& part, const Place& place,
                     PartViews& views, std::size_t& rays_left) const;
  std::vector<std::size_t> candidates(const EsdfMap& esdf, const FrontierPart& part,
                                      std::span<const Place> places) const;

  FieldOfView view_;
  int headings_;
  VoxelRange within_;
  double deepest_;
  double steepest_, least_cosine_;
  std::vector<Eigen::Vector2d> forward_;     ///< by heading
  std::map<VoxelIndex, PartViews> of_part_;  ///< by the part's first voxel
  std::set<std::tuple<std::uint64_t, VoxelIndex, std::uint64_t>> banned_;
  std::vector<std::vector<Sight>> from_places_;
  std::size_t part_count_ = 0;
  Bounds changed_;           ///< around all that has changed since the last update
  std::uint64_t noted_ = 0;  ///< the version of the frontiers whose changes are in it
};

}  // namespace ridgeway::detail
