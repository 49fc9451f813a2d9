// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "depth_surfaces.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

constexpr int kTile = 4;    // pixels along one side
constexpr int kAround = 2;  // tiles to each side in which noise is alike

/// Sums over pixels of what a least-squares plane needs, q the inverse depth: 1, u, v, u u, u v,
/// v v, q, u q, v q, q q.
using Sums = Eigen::Array<double, 10, 1>;

/// Rows below and columns right of the first hold the sums of all tiles above and left of them.
class TileSums {
 public:
  TileSums(const DepthImage& image, const PinholeCamera& camera)
      : across_((image.width + kTile - 1) / kTile),
        down_((image.height + kTile - 1) / kTile),
        sums_(static_cast<std::size_t>((across_ + 1) * (down_ + 1)), Sums::Zero()) {
    parallel_for_each_index(static_cast<std::size_t>(down_), [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < across_; ++x) place(x + 1, y + 1) = sum_of_tile(image, camera, x, y);
    });
    for (int y = 1; y <= down_; ++y)
      for (int x = 1; x <= across_; ++x)
        place(x, y) += place(x - 1, y) + place(x, y - 1) - place(x - 1, y - 1);
  }

  int across() const { return across_; }
  int down() const { return down_; }

  /// Over the tiles within `reach` of one, both ways.
  Sums window(int x, int y, int reach) const {
    const int x0 = std::clamp(x - reach, 0, across_), x1 = std::clamp(x + reach + 1, 0, across_);
    const int y0 = std::clamp(y - reach, 0, down_), y1 = std::clamp(y + reach + 1, 0, down_);
    return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
  }

 private:
  static Sums sum_of_tile(const DepthImage& image, const PinholeCamera& camera, int x, int y) {
    Sums sums = Sums::Zero();
    const int left = x * kTile, top = y * kTile;
    for (int v = top; v < std::min(top + kTile, image.height); ++v)
      for (int u = left; u < std::min(left + kTile, image.width); ++u) {
        const double depth = static_cast<double>(image.at(u, v));
        if (!(depth > 0.0)) continue;
        const double q = 1.0 / depth, a = u - camera.cx, b = v - camera.cy;
        sums += Sums{1.0, a, b, a * a, a * b, b * b, q, a * q, b * q, q * q};
      }
    return sums;
  }

  const Sums& at(int x, int y) const {
    return sums_[static_cast<std::size_t>(y * (across_ + 1) + x)];
  }
  Sums& place(int x, int y) { return sums_[static_cast<std::size_t>(y * (across_ + 1) + x)]; }

  int across_, down_;
  std::vector<Sums> sums_;
};

struct Plane {
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  // of the inverse depth along u, v; and at 0, 0
  double residual = std::numeric_limits<double>::infinity();  // mean square
  double reach = 0.0;  // of the inverse depth: a pixel farther off is not on it
};

Plane fit(const Sums& s) {
  constexpr double kFewest = 12.0;
  if (s[0] < kFewest) return {};
  // About the mean, two unknowns are left.
  const double u = s[1] / s[0], v = s[2] / s[0], q = s[6] / s[0];
  const double uu = s[3] / s[0] - u * u, uv = s[4] / s[0] - u * v, vv = s[5] / s[0] - v * v;
  const double uq = s[7] / s[0] - u * q, vq = s[8] / s[0] - v * q, qq = s[9] / s[0] - q * q;
  const double determinant = uu * vv - uv * uv;
  if (determinant < 0.1 * uu * vv || uu < 0.5 || vv < 0.5) return {};  // all on a line
  const double a = (uq * vv - vq * uv) / determinant, b = (vq * uu - uq * uv) / determinant;
  return {{a, b, q - a * u - b * v}, std::max(qq - a * uq - b * vq, 0.0)};
}

/// The best of the windows of a size that hold a tile.
Plane best_plane(const TileSums& sums, int x, int y, int reach) {
  Plane best;
  for (const auto& [dx, dy] : {std::array{0, 0}, std::array{-1, -1}, std::array{1, -1},
                               std::array{-1, 1}, std::array{1, 1}}) {
    const Plane plane = fit(sums.window(x + dx * reach, y + dy * reach, reach));
    if (plane.residual < best.residual) best = plane;
  }
  return best;
}

/// Of the tiles around one, in ascending order, the one that a quarter of them come before.
double lower_quartile(const std::vector<double>& values) {
  constexpr std::size_t kMost = (2 * kAround + 1) * (2 * kAround + 1);
  std::array<double, kMost / 4 + 1> least{};  // of those so far, as many as are of interest
  const std::size_t wanted = values.size() / 4;
  std::size_t count = 0;
  for (const double value : values) {
    if (count > wanted && value >= least[wanted]) continue;
    std::size_t place = count > wanted ? wanted : count++;
    for (; place > 0 && least[place - 1] > value; --place) least[place] = least[place - 1];
    least[place] = value;
  }
  return least[wanted];
}

/// Standard deviation of the inverse depth's noise around each tile: that of the calmer quarter of
/// the tiles there, each by a plane of its own. Edges of objects make the others look noisier.
std::vector<double> noise_of(const TileSums& sums) {
  constexpr double kUnknowns = 3.0 / (kTile * kTile);  // a plane fits that share of the noise too
  constexpr double kCalmQuarter = 0.74;  // lower quartile of chi squared over its mean, 13 degrees
  const auto across = static_cast<std::size_t>(sums.across());
  std::vector<double> residual(across * static_cast<std::size_t>(sums.down()));
  parallel_for_each_index(static_cast<std::size_t>(sums.down()), [&](std::size_t row) {
    for (std::size_t x = 0; x < across; ++x)
      residual[row * across + x] =
          fit(sums.window(static_cast<int>(x), static_cast<int>(row), 0)).residual;
  });
  std::vector<double> noise(residual.size(), 0.0);
  parallel_for_each_index(static_cast<std::size_t>(sums.down()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<double> around;
    for (int x = 0; x < sums.across(); ++x) {
      around.clear();
      for (int b = std::max(y - kAround, 0); b <= std::min(y + kAround, sums.down() - 1); ++b)
        for (int a = std::max(x - kAround, 0); a <= std::min(x + kAround, sums.across() - 1); ++a) {
          const double r =
              residual[static_cast<std::size_t>(b) * across + static_cast<std::size_t>(a)];
          if (std::isfinite(r)) around.push_back(r);
        }
      if (around.empty()) continue;
      noise[row * across + static_cast<std::size_t>(x)] =
          std::sqrt(lower_quartile(around) / (kCalmQuarter * (1.0 - kUnknowns)));
    }
  });
  return noise;
}

/// The plane of each tile, and how far a pixel may be off it to be taken for a part of it.
std::vector<Plane> fit_tiles(const TileSums& sums, const std::vector<double>& noise) {
  constexpr int kWide = 2, kNarrow = 1;  // tiles to each side
  constexpr double kMuchBetter = 0.1;    // of the wide one's mean square
  constexpr double kOutlier = 4.0;       // standard deviations
  std::vector<Plane> planes(static_cast<std::size_t>(sums.across() * sums.down()));
  parallel_for_each_index(static_cast<std::size_t>(sums.down()), [&](std::size_t row) {
    for (int x = 0; x < sums.across(); ++x) {
      const std::size_t tile =
          row * static_cast<std::size_t>(sums.across()) + static_cast<std::size_t>(x);
      const int y = static_cast<int>(row);
      Plane& plane = planes[tile];
      plane = best_plane(sums, x, y, kWide);
      // Nothing can be much better than the noise itself.
      if (kMuchBetter * plane.residual > 0.1 * noise[tile] * noise[tile]) {
        const Plane narrow = best_plane(sums, x, y, kNarrow);
        if (narrow.residual < kMuchBetter * plane.residual) plane = narrow;
      }
      plane.reach = kOutlier * std::sqrt(plane.residual);
    }
  });
  return planes;
}

/// 1 / z = a u + b v + c is the plane a fx X + b fy Y + c Z = 1.
Eigen::Vector3f normal_of(const Plane& plane, const PinholeCamera& camera) {
  if (std::isinf(plane.residual)) return Eigen::Vector3f::Zero();
  const Eigen::Vector3d m(plane.slope.x() * camera.fx, plane.slope.y() * camera.fy,
                          plane.slope.z());
  if (!(m.squaredNorm() > 0.0)) return Eigen::Vector3f::Zero();
  return -m.normalized().cast<float>();
}

struct Choice {
  std::uint32_t tile;
  double off = std::numeric_limits<double>::infinity();  // of the inverse depth, from its plane
};

/// The plane of a pixel's own tile if it is off by at most `noise`; else that it fits best of those
/// around, or none.
Choice choose_plane(const std::vector<Plane>& planes, const TileSums& sums, int x, int y,
                    const Eigen::Vector3d& pixel, double inverse, double noise) {
  constexpr double kRounding = 1e-3;  // of the inverse depth
  constexpr double kSpotOn = 1e-5;    // of the inverse depth: no other plane can be better
  Choice best{static_cast<std::uint32_t>(planes.size())};
  const auto consider = [&](int a, int b) {
    const auto tile = static_cast<std::uint32_t>(b * sums.across() + a);
    const Plane& plane = planes[tile];
    const double off = std::abs(plane.slope.dot(pixel) - inverse);
    if (off < best.off && off <= plane.reach + kRounding * inverse) best = {tile, off};
  };
  consider(x, y);
  if (best.off <= std::max(noise, kSpotOn * inverse)) return best;
  for (int b = std::max(y - 1, 0); b <= std::min(y + 1, sums.down() - 1); ++b)
    for (int a = std::max(x - 1, 0); a <= std::min(x + 1, sums.across() - 1); ++a) consider(a, b);
  return best;
}

/// Of a pixel that is on a plane, see DepthSurfaces' list of strays.
constexpr float kNoStray = -1.0f;

/// Whether two of the eight pixels around a stray are strays too and measure the same.
bool is_supported(const DepthImage& image, const std::vector<float>& stray, int u, int v) {
  constexpr double kAlike = 0.05;  // of the depth
  const auto place = [&](int x, int y) { return static_cast<std::size_t>(y * image.width + x); };
  const auto depth = static_cast<double>(image.at(u, v));
  const double alike = kAlike * depth + static_cast<double>(stray[place(u, v)]) * depth * depth;
  int supporters = 0;
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, image.height - 1); ++y)
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, image.width - 1); ++x)
      supporters += (x != u || y != v) && stray[place(x, y)] >= 0.0f &&
                    std::abs(static_cast<double>(image.at(x, y)) - depth) <= alike;
  return supporters >= 2;
}

/// Drops the strays that stand alone.
void drop_outliers(const DepthImage& raw, const std::vector<float>& stray, DepthImage& image) {
  parallel_for_each_index(static_cast<std::size_t>(raw.height), [&](std::size_t row) {
    const std::size_t first = row * static_cast<std::size_t>(raw.width);
    for (int u = 0; u < raw.width; ++u)
      if (stray[first + static_cast<std::size_t>(u)] >= 0.0f &&
          !is_supported(raw, stray, u, static_cast<int>(row)))
        image.depth[first + static_cast<std::size_t>(u)] = 0.0f;
  });
}

}  // namespace

DepthSurfaces::DepthSurfaces(const DepthImage& raw, const PinholeCamera& camera)
    : image_(raw), tile_(raw.depth.size()) {
  constexpr double kMostNoise = 3.0;  // standard deviations
  const TileSums sums(raw, camera);
  const std::vector<double> noise = noise_of(sums);
  const std::vector<Plane> planes = fit_tiles(sums, noise);
  for (const Plane& plane : planes) normals_.push_back(normal_of(plane, camera));
  normals_.emplace_back(Eigen::Vector3f::Zero());
  std::vector<float> stray(raw.depth.size(), kNoStray);  // noise at pixels that are farther off
  parallel_for_each_index(static_cast<std::size_t>(raw.height), [&](std::size_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < raw.width; ++u) {
      const std::size_t at = pixel(u, v);
      tile_[at] = static_cast<std::uint32_t>(planes.size());
      const auto depth = static_cast<double>(raw.depth[at]);
      if (depth == 0.0) continue;
      const int x = u / kTile, y = v / kTile;
      const Eigen::Vector3d ray(u - camera.cx, v - camera.cy, 1.0);
      const double sigma = noise[static_cast<std::size_t>(y * sums.across() + x)];
      const double most = std::min(kMostNoise * sigma, 0.5 / depth);
      const Choice choice = choose_plane(planes, sums, x, y, ray, 1.0 / depth, most);
      tile_[at] = choice.tile;
      if (choice.off <= most)
        image_.depth[at] = static_cast<float>(1.0 / planes[choice.tile].slope.dot(ray));
      else
        stray[at] = static_cast<float>(sigma);
    }
  });
  drop_outliers(raw, stray, image_);
}

}  // namespace ridgeway::detail
