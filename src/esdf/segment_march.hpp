// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>

#include "obstacle_scan.hpp"
#include "site_limit.hpp"

namespace ridgeway::detail {

using Vector = Eigen::Vector3d;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// voxel_at() of a point in voxels, without its divisions.
inline VoxelIndex voxel_holding(const Vector& p) {
  return {floor_to_int(p.x()), floor_to_int(p.y()), floor_to_int(p.z())};
}

/// Squared distance (voxel units) that a voxel's stored value stands for; a voxel without a site
/// is at least `far` from everything.
inline double stored(const EsdfMap& esdf, VoxelId id, double far) {
  return esdf.squared[id] == kNoSite ? far : 0.25 * esdf.squared[id];
}

inline double squared_far(const EsdfMap& esdf) {
  const double far = site_limit(esdf.max_distance / esdf.voxel_size);
  return far * far;
}

/// How far coordinates may be rounded, those of the world too: voxels.
inline double rounding(const EsdfMap& esdf) {
  constexpr double kOwn = 1e-9, kMetres = 1e-8;
  return std::max(kOwn, kMetres / esdf.voxel_size);
}

/// Lower bound of D^2 at a point from the ball that is free around the centre of its voxel.
inline double ball_bound(const EsdfMap& esdf, VoxelFinder& finder, const Vector& p, double far) {
  const VoxelIndex voxel = voxel_holding(p);
  const VoxelId id = finder.find(voxel);
  if (id == kNoVoxel) return 0.0;
  const double off = (p - Vector(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5)).norm();
  const double distance = std::max(std::sqrt(stored(esdf, id, far)) - off, 0.0);
  return distance * distance;
}

/// The squared distances (4 d^2) of the eight voxel centres around a place, in pairs along x.
struct CentresAround {
  using Pair = std::int32_t __attribute__((vector_size(8)));
  std::array<Pair, 4> pairs;

  /// Whether all are known, and below 2^31.
  bool are_small() const {
    const Pair any = pairs[0] | pairs[1] | pairs[2] | pairs[3];
    return (any[0] | any[1]) >= 0;
  }
};

/// Around a cube of eight voxels inside a block, of which the first is given.
inline CentresAround centres_in_block(const std::uint32_t* squared) {
  constexpr int kRow = kBlockSide, kLayer = kBlockSide * kBlockSide;
  const auto pair_at = [&](int first) {
    CentresAround::Pair pair;
    std::memcpy(&pair, squared + first, sizeof(pair));
    return pair;
  };
  return {{pair_at(0), pair_at(kRow), pair_at(kLayer), pair_at(kLayer + kRow)}};
}

/// Around the cube of eight voxels that begins at `base` and lies in several blocks. Where one is
/// missing it is solid, or nothing is known if unknown space is no obstacle.
inline std::optional<CentresAround> centres_across_blocks(const EsdfMap& esdf,
                                                          const VoxelIndex& base) {
  static constexpr std::array<std::uint32_t, kBlockVoxels> kSolid{};
  constexpr int kLast = kBlockSide - 1;
  const int x = base.x & kLast, y = base.y & kLast, z = base.z & kLast;
  const int crossed = (x == kLast ? 1 : 0) | (y == kLast ? 2 : 0) | (z == kLast ? 4 : 0);
  std::array<const std::uint32_t*, 8> blocks;  // by the axes along which they are the next one
  for (int next = crossed;; next = (next - 1) & crossed) {
    const std::uint32_t slot =
        esdf.layout.find_block(block_of(base) + BlockIndex{next & 1, next >> 1 & 1, next >> 2 & 1});
    if (slot == BlockLayout::kNoBlock && esdf.unknown != UnknownPolicy::kObstacle) return {};
    blocks[static_cast<std::size_t>(next)] =
        slot == BlockLayout::kNoBlock ? kSolid.data() : esdf.squared.block(slot);
    if (next == 0) break;
  }
  CentresAround centres;
  for (int row = 0; row < 4; ++row) {
    const int place = ((y + (row & 1)) & kLast) << kBlockBits | ((z + (row >> 1)) & kLast)
                                                                    << (2 * kBlockBits);
    const auto value = [&](int dx) {
      const std::uint32_t* block = blocks[static_cast<std::size_t>((2 * row + dx) & crossed)];
      return static_cast<std::int32_t>(block[place + ((x + dx) & kLast)]);
    };
    centres.pairs[static_cast<std::size_t>(row)] = CentresAround::Pair{value(0), value(1)};
  }
  return centres;
}

/// What they are worth at a place inside the cube, in voxels; `far`: where one is not known.
inline double interpolate(const CentresAround& centres, const Vector& t, double far) {
  using Real = double __attribute__((vector_size(16)));
  std::array<Real, 4> rows;
  if (centres.are_small()) {
    for (std::size_t i = 0; i < 4; ++i) rows[i] = __builtin_convertvector(centres.pairs[i], Real);
  } else {
    const auto known = [far](std::int32_t value) {
      const auto squared = static_cast<std::uint32_t>(value);
      return squared == kNoSite ? 4.0 * far : squared;
    };
    for (std::size_t i = 0; i < 4; ++i)
      rows[i] = Real{known(centres.pairs[i][0]), known(centres.pairs[i][1])};
  }
  const auto between = [](const Real& a, const Real& b, double share) {
    return a + share * (b - a);
  };
  const Real both =
      between(between(rows[0], rows[1], t.y()), between(rows[2], rows[3], t.y()), t.z());
  return 0.25 * (both[0] + t.x() * (both[1] - both[0]));
}

/// Lower bound of D^2 at a point from the eight voxel centres around it: trilinear interpolation
/// of d^2 less the sum of t (1 - t), since D^2(x) - |x|^2 is concave. Where nothing is known of one
/// of them, from the ball around the centre of the point's own voxel.
inline double lower_bound(const EsdfMap& esdf, VoxelFinder& finder, const Vector& p, double far) {
  const Vector shifted = p - Vector::Constant(0.5);
  const VoxelIndex base = voxel_holding(shifted);
  const Vector t = shifted - Vector(base.x, base.y, base.z);
  const double excess = (t.array() * (1.0 - t.array())).sum();
  const VoxelId first = finder.find(base);
  const auto is_inside = [](int i) { return (i & (kBlockSide - 1)) != kBlockSide - 1; };
  if (first != kNoVoxel && is_inside(base.x) && is_inside(base.y) && is_inside(base.z))
    return interpolate(centres_in_block(&esdf.squared[first]), t, far) - excess;
  const std::optional<CentresAround> centres = centres_across_blocks(esdf, base);
  return centres ? interpolate(*centres, t, far) - excess : ball_bound(esdf, finder, p, far);
}

/// What a march along a segment is to find out.
enum class Wanted { kWhether, kWhere, kWhetherClearly, kWhereClearly };

/// D^2 along a segment, in voxel units. Lower bounds of it at two places bound it between them too,
/// since it is concave but for |x|^2: from a place that is far from everything the march takes a
/// long step, close to obstacles a short one, and where bounds do not decide it looks at the
/// obstacles themselves.
///
/// Plain form of minimum(): brute_squared_distance() in plain_distances.hpp; the others tell
/// whether that is below a limit, and where. From it, docs/fast-kernels.md section 2: bounds at a
/// point (1) and between two (2), steps (3, 4), a limit that falls (5), places that decide at once
/// (6).
class SegmentMarch {
 public:
  SegmentMarch(const EsdfMap& esdf, const Vector& a, const Vector& b)
      : esdf_(esdf), finder_(esdf.layout), a_(a), length_((b - a).norm()), far_(squared_far(esdf)) {
    along_ = length_ > 0.0 ? Vector((b - a) / length_) : Vector::Zero();
  }

  /// Where, in voxels from the start, a stretch of at most a voxel begins on which D^2 falls below
  /// the limit; infinite if there is none. Wanted::kWhether: some place that is too low, not the
  /// first; kWhetherClearly, kWhereClearly: also one that might be.
  template <Wanted wanted>
  double doubt(double limit) {
    constexpr bool is_first = wanted == Wanted::kWhere || wanted == Wanted::kWhereClearly;
    constexpr bool is_clear = wanted == Wanted::kWhetherClearly || wanted == Wanted::kWhereClearly;
    double place = kInfinity;
    if (!is_first)  // most that are not free show it at a glance
      for (const double share : {0.5, 0.25, 0.75})
        if (is_low(at(share * length_), limit)) return share * length_;
    const auto on_low = [&](double t) {
      if (!is_first && is_low(at(t), limit)) place = t;
      return std::isinf(place);
    };
    march(limit, on_low, [&](double t, double end) {
      if (is_clear || !close_stays_above(t, end, limit)) place = t;
      return std::isinf(place);
    });
    return place;
  }

  /// Upper bound of min D^2, if below `best`, else `best`: from the sites of some voxels on the way
  /// that may be as near.
  double upper_bound(double best) {
    double near = within_voxel_of(best);
    const auto look = [&](double t) {
      const double squared = at_site(at(t), near);
      if (squared >= best) return;
      best = squared;
      near = within_voxel_of(best);
    };
    look(0.0);
    look(length_);
    for (double t = 4.0; t < length_; t += 8.0) look(t);
    return best;
  }

  /// min D^2 along the segment, if below `best` (finite), else `best`.
  double minimum(double best) {
    // What is nearest at an end of the whole segment is known where that is a voxel's centre; what
    // is nearest at an end of a stretch alone is nearer to the next one.
    const bool is_start_known = is_known_centre(at(0.0)),
               is_end_known = is_known_centre(at(length_));
    if (is_start_known) best = std::min(best, at_site(at(0.0)));
    if (is_end_known) best = std::min(best, at_site(at(length_)));
    march(
        best, [](double) { return true; },
        [&](double t, double end) {
          const bool is_between = (t > 0.0 || is_start_known) && (end < length_ || is_end_known);
          ObstacleScan scan(esdf_, at(t), at(end));
          best = is_between ? scan.run_across(best) : scan.run(best);
          return best > 0.0;
        });
    return best;
  }

 private:
  static constexpr double kCloseStep = 1.0;  // voxels looked at closely at a time

  Vector at(double t) const { return a_ + t * along_; }
  double bound_at(double t) { return lower_bound(esdf_, finder_, at(t), far_); }

  /// Whether a point is the centre of a voxel that knows its nearest site.
  bool is_known_centre(const Vector& p) {
    constexpr double kSlack = 1e-9;
    const VoxelIndex voxel = voxel_holding(p);
    const Vector off = p - Vector(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5);
    if (off.cwiseAbs().maxCoeff() > kSlack) return false;
    const VoxelId id = finder_.find(voxel);
    return id != kNoVoxel && esdf_.squared[id] != kNoSite;
  }

  /// Goes along the segment as far as bounds show D^2 >= limit, which may fall meanwhile. Where
  /// they do not, it calls `on_low(place)` with a place ahead whose bound is below the limit, and
  /// looks closer; at last `on_close(begin, end)` with a stretch of at most kCloseStep, and goes on
  /// behind it. Stops where one of them returns false.
  template <typename OnLow, typename OnClose>
  void march(const double& limit, const OnLow& on_low, const OnClose& on_close) {
    double t = 0.0, bound = bound_at(0.0), slope = 0.0;
    bool is_close = false;
    do {
      // Two places with this bound may be so far apart.
      const double step = bound > limit && !is_close ? 2.0 * std::sqrt(bound - limit) : 0.0;
      is_close = step <= kCloseStep;
      double end = std::min(t + std::max(likely_step(step, slope), kCloseStep), length_);
      double bound_ahead = bound_at(end);
      if (bound_between(bound, bound_ahead, end - t) < limit) {
        if (is_close) {
          if (!on_close(t, end)) return;
        } else {
          if (bound_ahead < limit && !on_low(end)) return;
          const double certain = certain_part(bound, bound_ahead, end - t, limit);
          is_close = certain < kCloseStep;
          if (is_close) continue;
          end = t + certain;
          bound_ahead = std::max(bound_at(end), limit);
        }
      }
      slope = (bound_ahead - bound) / (end - t);
      t = end;
      bound = bound_ahead;
      is_close = false;
    } while (t < length_);
  }

  /// Whether D^2(x) is below the limit for certain, by the distance at the centre of its voxel.
  bool is_low(const Vector& x, double limit) {
    const VoxelIndex voxel = voxel_holding(x);
    const VoxelId id = finder_.find(voxel);
    if (id == kNoVoxel) return limit > 0.0 && esdf_.is_obstacle(id);
    const double squared = 0.25 * esdf_.squared[id];
    if (squared >= limit || esdf_.squared[id] == kNoSite) return false;
    const double off = (x - Vector(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5)).norm();
    const double farthest = std::sqrt(squared) + off;
    return farthest * farthest < limit;
  }

  /// Squared distance that the centre of a voxel has at most where one of its places has D^2 of at
  /// most this.
  static double within_voxel_of(double squared) {
    const double distance = std::sqrt(squared) + 0.5 * std::numbers::sqrt3 + 1e-9;
    return distance * distance;
  }

  /// Squared distance from x to the site of its voxel: never too small. Infinite where the voxel's
  /// centre is farther than that from it.
  double at_site(const Vector& x, double farthest = kInfinity) {
    VoxelIndex voxel = voxel_holding(x);
    VoxelId id = finder_.find(voxel);
    if (id == kNoVoxel && esdf_.is_obstacle(id)) return 0.0;
    if (id == kNoVoxel) {  // an upper face of the map's blocks is of the voxels below, too
      voxel = voxel_holding(x - Vector::Constant(rounding(esdf_)));
      id = finder_.find(voxel);
      if (id == kNoVoxel) return kInfinity;
    }
    if (esdf_.squared[id] == kNoSite || 0.25 * esdf_.squared[id] > farthest) return kInfinity;
    const SiteOffset o = esdf_.site[id];
    return squared_distance(x, cube_of(voxel + VoxelIndex{o.x, o.y, o.z}));
  }

  /// Lower bound of D^2 between two places `length` apart, by concavity from bounds there: the
  /// minimum over x of b0 + (b1 - b0) x / length - x (length - x).
  static double bound_between(double b0, double b1, double length) {
    const double squared = length * length, rise = std::abs(b1 - b0);
    if (rise >= squared) return std::min(b0, b1);
    return 0.5 * (b0 + b1) - 0.25 * squared - 0.25 * rise * rise / squared;
  }

  /// About as far as bound_between() allows if the bound goes on to fall as it did (`slope`, for
  /// each voxel), where it would allow a step if it stayed level. Less by a tenth, as a step too
  /// far costs more than one too short.
  static double likely_step(double level_step, double slope) {
    return std::max(0.9 * level_step + std::min(slope, 0.0), 0.5 * level_step);
  }

  /// The first x at which that falls to the limit, if it is above at 0; else 0.
  static double certain_part(double b0, double b1, double length, double limit) {
    const double half = 0.5 * (length - (b1 - b0) / length);
    const double root = half * half - (b0 - limit);
    return b0 > limit && root > 0.0 ? half - std::sqrt(root) : 0.0;
  }

  bool close_stays_above(double t0, double t1, double limit) {
    if (at_site(at(t0)) < limit || at_site(at(t1)) < limit) return false;
    return ObstacleScan(esdf_, at(t0), at(t1)).run(limit) >= limit;
  }

  const EsdfMap& esdf_;
  VoxelFinder finder_;
  const Vector a_;
  const double length_;
  const double far_;
  Vector along_;
};

}  // namespace ridgeway::detail
