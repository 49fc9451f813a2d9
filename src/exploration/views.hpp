// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
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
  Bounds widened(double by) const { return {low.array() - by, high.array() + by}; }
  bool meets(const Bounds& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  /// Whether it shares a point with the segment from a to b.
  bool meets(const Point& a, const Point& b) const {
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = b[axis] - a[axis];
      if (along == 0.0) {
        if (a[axis] < low[axis] || a[axis] > high[axis]) return false;
        continue;
      }
      const double in = (low[axis] - a[axis]) / along, out = (high[axis] - a[axis]) / along;
      first = std::max(first, std::min(in, out));
      last = std::min(last, std::max(in, out));
    }
    return first <= last;
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
/// again where the map has changed between a place and a part. Until there is time for that what
/// was seen before counts.
class Views {
 public:
  /// `within`: voxels of the lattice that are to be seen. `deepest`: metres of unknown space behind
  /// a frontier that count at most; 0: frontiers count by their voxels alone.
  Views(const FieldOfView& view, int headings, const VoxelRange& within, double deepest);

  /// `places` must stay until the next update. Looks at the parts of clusters with `least` voxels
  /// or more from the nearest places, and from farther ones where none of these sees a part, with
  /// no more than so many rays: two thirds of them at parts near to a point first, the others at
  /// those that have waited longest. A thorough look is one at all targets from all places. Returns
  /// whether the rays were enough.
  bool update(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
              std::span<const Place> places, const Point& near, std::size_t most_rays,
              bool thorough);

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
    bool all_seen = false, is_stale = false;
  };
  /// A place from which a part might be seen.
  struct Candidate {
    double distance = 0.0;
    std::uint32_t place = 0;
    std::int32_t cached = -1;  ///< what was seen from there; below 0: it was not asked yet
  };
  struct PartViews {
    std::uint64_t version = 0;
    bool thorough = false;
    std::uint64_t live = 0;    ///< the last update in which there was such a part
    std::uint64_t served = 0;  ///< the last one in which all its rays were cast
    double worth = 1.0;
    std::vector<Candidate> candidates;  ///< the nearest first
    std::vector<Cached> cached;
    std::vector<std::uint64_t> banned;  ///< ids of places
  };
  struct Waiting {
    double distance = 0.0;  ///< squared
    std::size_t part = 0;
    PartViews* views = nullptr;
  };
  using PartVersion = std::pair<VoxelIndex, std::uint64_t>;

  void follow_places(std::span<const Place> places);
  void mark_changed(const Roadmap& roadmap, const Bounds& changed);
  std::vector<Waiting> follow_parts(const Roadmap& roadmap, const Frontiers& frontiers,
                                    std::size_t least, const Point& near, bool thorough,
                                    const Bounds& changed);
  void find_candidates(const EsdfMap& esdf, const FrontierPart& part, bool is_new,
                       PartViews& views) const;
  bool is_candidate(const EsdfMap& esdf, const FrontierPart& part, const Place& place,
                    double& distance) const;
  double share_from(double distance) const;
  bool is_banned(const Place& place, const FrontierPart& part) const;
  template <typename Visit>
  void for_each_asked(PartViews& views, const Visit& visit) const;
  bool serve(const Roadmap& roadmap, std::span<const FrontierPart> parts,
             std::span<const Waiting> waiting, std::size_t& rays_left) const;
  bool serve(const Roadmap& roadmap, const FrontierPart& part, PartViews& views,
             std::size_t& rays_left) const;
  static std::size_t looks_at(const FrontierPart& part, const PartViews& views);
  static std::size_t most_rays_of(const FrontierPart& part, const PartViews& views);
  bool look(const Roadmap& roadmap, const FrontierPart& part, Candidate& candidate,
            PartViews& views, std::size_t& rays_left) const;
  void gather(std::span<const Waiting> waiting);

  FieldOfView view_;
  int headings_;
  VoxelRange within_;
  double deepest_;
  double steepest_, steepest_to_edge_, least_cosine_;
  std::vector<Eigen::Vector2d> forward_;                      ///< by heading
  std::map<VoxelIndex, PartViews> of_part_;                   ///< by the part's first voxel
  std::map<PartVersion, std::vector<std::uint64_t>> banned_;  ///< ids of places
  std::vector<std::vector<Sight>> from_places_;
  std::size_t part_count_ = 0;
  std::span<const Place> places_;                              ///< of this update
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_;  ///< of places, by id
  static constexpr std::uint32_t kGone = ~std::uint32_t{0};
  std::vector<std::uint32_t> now_at_;      ///< index of a place now, by that in the last update
  std::vector<std::uint32_t> new_places_;  ///< that were not there in the last update
  bool places_changed_ = false;
  std::uint64_t updates_ = 0;
  Bounds changed_;              ///< around all that has changed since the last update
  std::vector<Bounds> closed_;  ///< blocks in which something is no longer free since then
  std::uint64_t noted_ = 0;     ///< the version of the frontiers whose changes are in it
};

}  // namespace ridgeway::detail
