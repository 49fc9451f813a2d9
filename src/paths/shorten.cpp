// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "shorten.hpp"

#include <algorithm>
#include <array>

namespace ridgeway::detail {
namespace {

constexpr int kRounds = 6;
constexpr int kBisections = 4;
constexpr double kWorthwhile = 1e-3;  // relative gain that makes a move worth it
constexpr double kStep = 8.0;         // metres between the places that skipping may choose from

/// Skips waypoints: from each one goes on to the farthest that can be seen, found by doubling
/// the stride and then halving it.
std::vector<Point> skip_forwards(const FreeSpace& space, const std::vector<Point>& path,
                                 double radius, const MayReplace& may_replace) {
  const auto can_skip = [&](std::size_t from, std::size_t to) {
    if (!space.is_free(path[from], path[to], radius)) return false;
    return !may_replace || may_replace(std::span(path).subspan(from, to - from + 1),
                                       std::array{path[from], path[to]});
  };
  std::vector<Point> result{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
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
    while (seen + 1 < blind) {
      const std::size_t middle = (seen + blind) / 2;
      (can_skip(at, middle) ? seen : blind) = middle;
    }
    result.push_back(path[seen]);
    at = seen;
  }
  return result;
}

/// Points along a path no farther apart than a step.
std::vector<Point> subdivide(const std::vector<Point>& path, double step) {
  std::vector<Point> result{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point& from = path[i - 1];
    const Point along = path[i] - from;
    const int pieces = static_cast<int>(along.norm() / step) + 1;
    for (int k = 1; k < pieces; ++k) result.emplace_back(from + along * k / pieces);
    result.push_back(path[i]);
  }
  return result;
}

/// Largest share in [0, 1) found by halving at which `is_free` holds; it holds at 0.
template <typename IsFree>
double largest_free_share(const IsFree& is_free) {
  double good = 0.0, bad = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (good + bad);
    (is_free(middle) ? good : bad) = middle;
  }
  return good;
}

/// A corner of a path that is made shorter, between its neighbours.
struct Corner {
  const Point& before;
  Point& at;
  const Point& after;

  double length() const { return length_over(at); }
  double length_over(const Point& p) const { return (p - before).norm() + (after - p).norm(); }
};

/// Moves a corner along one of its two segments, as far as it stays free: one of the two new
/// segments is part of an old one.
template <typename MayBecome>
void slide(const FreeSpace& space, Corner& corner, double radius, const MayBecome& may_become) {
  const Point old = corner.at;
  const double back = largest_free_share([&](double share) {
    const Point p = old + share * (corner.before - old);
    return space.is_clearly_free(p, corner.after, radius) && may_become(p);
  });
  const double on = largest_free_share([&](double share) {
    const Point p = old + share * (corner.after - old);
    return space.is_clearly_free(corner.before, p, radius) && may_become(p);
  });
  const Point backward = old + back * (corner.before - old);
  const Point onward = old + on * (corner.after - old);
  corner.at = corner.length_over(backward) < corner.length_over(onward) ? backward : onward;
}

/// Moves a corner towards the line between its neighbours, as far as it stays free.
template <typename MayBecome>
void draw_in(const FreeSpace& space, Corner& corner, double radius, const MayBecome& may_become) {
  const Point old = corner.at, along = corner.after - corner.before;
  const double squared = along.squaredNorm();
  const double t =
      squared > 0.0 ? std::clamp((old - corner.before).dot(along) / squared, 0.0, 1.0) : 0.0;
  const Point target = corner.before + t * along;
  const double in = largest_free_share([&](double share) {
    const Point p = old + share * (target - old);
    return space.is_clearly_free(corner.before, p, radius) &&
           space.is_clearly_free(p, corner.after, radius) && may_become(p);
  });
  corner.at = old + in * (target - old);
}

/// The corners of a path pulled taut, round by round.
class Tightening {
 public:
  Tightening(const FreeSpace& space, std::vector<Point> path, double radius,
             const MayReplace& may_replace)
      : space_(space),
        radius_(radius),
        may_replace_(may_replace),
        path_(std::move(path)),
        moved_(path_.size(), true) {}

  /// Tries every corner that moved, or has a neighbour that did, and in the first rounds all of
  /// them: whether it can go, or else one of three moves, by the round. Whether to go on.
  bool run_round(int round) {
    const bool all = round < kMoves;
    bool was_worth_it = round + 1 < kMoves;
    for (std::size_t i = 1; i + 1 < path_.size();) {
      const bool may_go = round == 0 || moved_[i - 1] || moved_[i + 1];
      if (may_go && can_go(i)) {
        erase(i);
        was_worth_it = true;
        continue;
      }
      if (!all && !may_go && !moved_[i]) {
        ++i;
        continue;
      }
      Corner corner{path_[i - 1], path_[i], path_[i + 1]};
      const double length = corner.length();
      const auto may_become = [&, old = std::array{corner.before, corner.at, corner.after}](
                                  const auto&... p) {
        return !may_replace_ || may_replace_(old, std::array{corner.before, p..., corner.after});
      };
      const int move = round % kMoves;
      const bool was_cut = move == 2 && cut(i, may_become);
      if (move == 0) slide(space_, corner, radius_, may_become);
      if (move == 1) draw_in(space_, corner, radius_, may_become);
      moved_[i] = was_cut || corner.length() < length * (1.0 - kWorthwhile);
      was_worth_it |= moved_[i];
      i += was_cut ? 2 : 1;
    }
    return was_worth_it;
  }

  const std::vector<Point>& path() const { return path_; }

 private:
  static constexpr int kMoves = 3;

  bool can_go(std::size_t i) const {
    const auto around = std::span(path_).subspan(i - 1, 3);
    return space_.is_free(around.front(), around.back(), radius_) &&
           (!may_replace_ || may_replace_(around, std::array{around.front(), around.back()}));
  }

  void erase(std::size_t i) {
    path_.erase(path_.begin() + static_cast<std::ptrdiff_t>(i));
    moved_.erase(moved_.begin() + static_cast<std::ptrdiff_t>(i));
    moved_[i - 1] = moved_[i] = true;
  }

  /// Takes a corner off, between the places farthest from it, by equal shares of its two segments,
  /// that see each other: a way round a box needs a corner more. Whether that was worth it.
  template <typename MayBecome>
  bool cut(std::size_t i, const MayBecome& may_become) {
    const Point at = path_[i], back = path_[i - 1] - at, on = path_[i + 1] - at;
    const double share = largest_free_share([&](double s) {
      const Point p = at + s * back, q = at + s * on;
      return space_.is_clearly_free(p, q, radius_) && may_become(p, q);
    });
    const double whole = back.norm() + on.norm();
    if (share * (whole - (on - back).norm()) < kWorthwhile * whole) return false;
    path_[i] = at + share * back;
    path_.insert(path_.begin() + static_cast<std::ptrdiff_t>(i + 1), at + share * on);
    moved_.insert(moved_.begin() + static_cast<std::ptrdiff_t>(i + 1), true);
    return true;
  }

  const FreeSpace& space_;
  const double radius_;
  const MayReplace& may_replace_;
  std::vector<Point> path_;
  std::vector<bool> moved_;  // since it was last tried
};

}  // namespace

double length_of(const std::vector<Point>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::vector<Point> skip_waypoints(const FreeSpace& space, std::vector<Point> path, double radius,
                                  const MayReplace& may_replace) {
  if (path.size() < 3) return path;
  for (int direction = 0; direction < 2; ++direction) {  // what one end cannot see, the other may
    path = skip_forwards(space, subdivide(path, kStep), radius, may_replace);
    std::reverse(path.begin(), path.end());
  }
  return path;
}

std::vector<Point> draw_corners_in(const FreeSpace& space, std::vector<Point> path, double radius,
                                   const Deadline& deadline, const MayReplace& may_replace) {
  Tightening tightening(space, std::move(path), radius, may_replace);
  for (int round = 0; round < kRounds && !deadline.has_passed(); ++round)
    if (!tightening.run_round(round)) break;
  return tightening.path();
}

std::vector<Point> shorten(const FreeSpace& space, std::vector<Point> path, double radius,
                           const Deadline& deadline, const MayReplace& may_replace) {
  path = skip_waypoints(space, std::move(path), radius, may_replace);
  return draw_corners_in(space, std::move(path), radius, deadline, may_replace);
}

}  // namespace ridgeway::detail
