// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "shorten.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace ridgeway::detail {
namespace {

constexpr double kRounding = 1e-9;

Point nearest_on_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return a + t * along;
}

/// Largest share in [0, 1) found by halving at which both hold; they hold at 0. `may_be_free` is
/// cheap and only ever wrong where it says yes, so it finds the place where to start with looks;
/// 0 where that place would not be worth it.
template <typename MayBeFree, typename IsWorthIt, typename IsFree>
double largest_free_share(const MayBeFree& may_be_free, const IsWorthIt& is_worth_it,
                          const IsFree& is_free) {
  double good = 0.0, bad = 1.0;
  for (int i = 0; i < kPlanning.tight_bisections; ++i) {
    const double middle = 0.5 * (good + bad);
    (may_be_free(middle) ? good : bad) = middle;
  }
  if (good == 0.0 || !is_worth_it(good)) return 0.0;
  if (is_free(good)) return good;
  bad = good;
  good = 0.0;
  for (int i = 0; i < kPlanning.tight_bisections; ++i) {
    const double middle = 0.5 * (good + bad);
    (may_be_free(middle) && is_free(middle) ? good : bad) = middle;
  }
  return good;
}

/// The corners of a path pulled tight, round by round.
class Tightening {
 public:
  Tightening(const FreeSpace& space, const std::vector<Point>& path, double radius,
             const MayReplace& may_replace, const DrawingIn& drawing)
      : space_(space),
        radius_(radius),
        may_replace_(may_replace),
        least_gain_(drawing.worthwhile * length_of(path)) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const bool is_settled = drawing.settled_first < i && i < drawing.settled_last;
      corners_.push_back({.at = path[i], .is_settled = is_settled, .moved = !is_settled});
    }
  }

  /// Tries every corner that moved, or has a neighbour that did, and in the first rounds all that
  /// are not settled: whether it can go, or else one of three moves, by the round. Whether to go
  /// on.
  bool run_round(int round) {
    bool was_worth_it = round + 1 < kMoves;
    for (std::size_t i = 1; i + 1 < corners_.size();) {
      const bool is_new = round < kMoves && !corners_[i].is_settled;
      const bool may_go = (round == 0 && is_new) || corners_[i - 1].moved || corners_[i + 1].moved;
      if (may_go && can_go(i)) {
        erase(i);
        was_worth_it = true;
        continue;
      }
      const bool is_due = is_new || may_go || corners_[i].moved;
      if (!is_due || most_gain(i) <= least_gain_) {
        corners_[i].moved = false;
        ++i;
        continue;
      }
      const double length = length_over(i, corners_[i].at);
      const int move = round % kMoves;
      const bool was_cut = move == 2 && cut(i);
      if (move == 0) slide(i);
      if (move == 1) draw_in(i);
      corners_[i].moved = was_cut || length_over(i, corners_[i].at) < length - least_gain_;
      was_worth_it |= corners_[i].moved;
      i += was_cut ? 2 : 1;
    }
    return was_worth_it;
  }

  std::vector<Point> path() const {
    std::vector<Point> path;
    for (const Corner& corner : corners_) path.push_back(corner.at);
    return path;
  }

 private:
  static constexpr int kMoves = 3;

  struct Corner {
    Point at;
    bool is_settled = false;
    bool moved = true;                ///< since it was last tried
    bool has_looked = false;          ///< for the obstacle
    std::optional<Point> obstacle{};  ///< a point of the one nearest to it
  };

  const std::optional<Point>& obstacle_near(std::size_t i) {
    Corner& corner = corners_[i];
    if (!corner.has_looked) corner.obstacle = space_.near_obstacle(corner.at);
    corner.has_looked = true;
    return corner.obstacle;
  }

  double length_over(std::size_t i, const Point& p) const {
    return (p - corners_[i - 1].at).norm() + (corners_[i + 1].at - p).norm();
  }

  /// What going straight would save.
  double most_gain(std::size_t i) const {
    return length_over(i, corners_[i].at) - (corners_[i + 1].at - corners_[i - 1].at).norm();
  }

  /// False where the segment passes one of the obstacles around a corner too closely.
  bool may_be_free(std::size_t i, const Point& a, const Point& b) {
    for (std::size_t k = i - 1; k <= i + 1; ++k)
      if (const std::optional<Point>& obstacle = obstacle_near(k);
          obstacle && (nearest_on_segment(*obstacle, a, b) - *obstacle).squaredNorm() <
                          radius_ * radius_ * (1.0 - kRounding))
        return false;
    return true;
  }

  template <typename... Points>
  bool may_become(std::size_t i, const Points&... p) const {
    if (!may_replace_) return true;
    const std::array old{corners_[i - 1].at, corners_[i].at, corners_[i + 1].at};
    return may_replace_(old, std::array{old.front(), p..., old.back()});
  }

  bool can_go(std::size_t i) {
    const Point &before = corners_[i - 1].at, &after = corners_[i + 1].at;
    return may_be_free(i, before, after) && space_.is_free(before, after, radius_) && may_become(i);
  }

  void erase(std::size_t i) {
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(i));
    corners_[i - 1].moved = corners_[i].moved = true;
  }

  /// Moves a corner along one of its two segments, as far as it stays free: one of the two new
  /// segments is part of an old one.
  void slide(std::size_t i) {
    const Point old = corners_[i].at;
    Point best = old;
    const auto try_towards = [&](const Point& end, const Point& other) {
      const auto place = [&](double share) -> Point { return old + share * (end - old); };
      const double share = largest_free_share(
          [&](double s) { return may_be_free(i, place(s), other); },
          [&](double s) { return length_over(i, place(s)) < length_over(i, best) - least_gain_; },
          [&](double s) {
            return space_.is_clearly_free(place(s), other, radius_) && may_become(i, place(s));
          });
      if (length_over(i, place(share)) < length_over(i, best)) best = place(share);
    };
    try_towards(corners_[i - 1].at, corners_[i + 1].at);
    try_towards(corners_[i + 1].at, corners_[i - 1].at);
    if (best != old) corners_[i] = {best};
  }

  /// Moves a corner towards the line between its neighbours, as far as it stays free.
  void draw_in(std::size_t i) {
    const Point old = corners_[i].at, before = corners_[i - 1].at, after = corners_[i + 1].at;
    const Point target = nearest_on_segment(old, before, after);
    const auto place = [&](double share) -> Point { return old + share * (target - old); };
    const double share = largest_free_share(
        [&](double s) {
          return may_be_free(i, before, place(s)) && may_be_free(i, place(s), after);
        },
        [&](double s) { return length_over(i, place(s)) < length_over(i, old) - least_gain_; },
        [&](double s) {
          return space_.is_clearly_free(before, place(s), radius_) &&
                 space_.is_clearly_free(place(s), after, radius_) && may_become(i, place(s));
        });
    if (share > 0.0) corners_[i] = {place(share)};
  }

  /// Takes a corner off, between the places farthest from it, by equal shares of its two segments,
  /// that see each other: a way round a box needs a corner more. Whether that was worth it.
  bool cut(std::size_t i) {
    const Point at = corners_[i].at;
    const Point back = corners_[i - 1].at - at, on = corners_[i + 1].at - at;
    const double saved = back.norm() + on.norm() - (on - back).norm();
    const double share =
        largest_free_share([&](double s) { return may_be_free(i, at + s * back, at + s * on); },
                           [&](double s) { return s * saved > least_gain_; },
                           [&](double s) {
                             const Point p = at + s * back, q = at + s * on;
                             return space_.is_clearly_free(p, q, radius_) && may_become(i, p, q);
                           });
    if (share * saved <= least_gain_) return false;
    corners_[i] = {at + share * back};
    corners_.insert(corners_.begin() + static_cast<std::ptrdiff_t>(i + 1), Corner{at + share * on});
    return true;
  }

  const FreeSpace& space_;
  const double radius_;
  const MayReplace& may_replace_;
  const double least_gain_;  ///< metres; moves that gain less are not tried
  std::vector<Corner> corners_;
};

}  // namespace

std::vector<Point> skip_waypoints(const FreeSpace& space, std::vector<Point> path, double radius,
                                  const Deadline& deadline, const MayReplace& may_replace) {
  if (path.size() < 3) return path;
  const auto can_skip = [&](std::size_t from, std::size_t to) {
    if (!space.is_free(path[from], path[to], radius)) return false;
    return !may_replace || may_replace(std::span(path).subspan(from, to - from + 1),
                                       std::array{path[from], path[to]});
  };
  std::vector<Point> result{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    if (deadline.has_passed()) {
      result.insert(result.end(), path.begin() + static_cast<std::ptrdiff_t>(at + 1), path.end());
      break;
    }
    std::size_t seen = at + 1, blind = path.size();
    for (std::size_t stride = 2; at + stride < path.size(); stride *= 2) {
      if (!can_skip(at, at + stride)) {
        blind = at + stride;
        break;
      }
      seen = at + stride;
    }
    if (blind == path.size() && seen + 1 < blind && can_skip(at, path.size() - 1))
      seen = path.size() - 1;
    while (blind - seen > 1 + (seen - at) / 8) {
      const std::size_t middle = (seen + blind) / 2;
      (can_skip(at, middle) ? seen : blind) = middle;
    }
    result.push_back(path[seen]);
    at = seen;
  }
  return result;
}

std::vector<Point> draw_corners_in(const FreeSpace& space, const std::vector<Point>& path,
                                   double radius, const Deadline& deadline,
                                   const MayReplace& may_replace, const DrawingIn& drawing) {
  Tightening tightening(space, path, radius, may_replace, drawing);
  for (int round = 0; !deadline.has_passed() && tightening.run_round(round); ++round) {
  }
  return tightening.path();
}

std::vector<Point> shorten(const FreeSpace& space, std::vector<Point> path, double radius,
                           const Deadline& deadline, const MayReplace& may_replace) {
  path = skip_waypoints(space, std::move(path), radius, deadline, may_replace);
  return draw_corners_in(space, path, radius, deadline, may_replace);
}

}  // namespace ridgeway::detail
