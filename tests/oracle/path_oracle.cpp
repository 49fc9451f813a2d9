// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// path_oracle MAP.bt PATHS.json: an independent judge of paths. Shares no code with the library:
// reads the map with liboctomap, keeps it as a plain dense grid, and looks along every path, point
// by point, at every voxel cube near enough to matter. Unknown space counts as occupied.
// PATHS.json: [{"radius": r, "waypoints": [[x, y, z], ...]}, ...], as `ridgeway check --paths`
// writes it. Prints one JSON object; exit code 1 if any point is closer than its path's radius.

#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace {

constexpr double kSlack = 1e-6;           // metres
constexpr double kSamplesPerVoxel = 5.0;  // along a path

struct Vec {
  double x, y, z;
};

/// Dense grid of "not known to be free", one voxel of border around all that is known.
class Grid {
 public:
  explicit Grid(const octomap::OcTree& tree) : s_(tree.getResolution()) {
    double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
    tree.getMetricMin(x0, y0, z0);
    tree.getMetricMax(x1, y1, z1);
    ox_ = std::lround(x0 / s_) - 1, oy_ = std::lround(y0 / s_) - 1, oz_ = std::lround(z0 / s_) - 1;
    nx_ = std::lround(x1 / s_) + 1 - ox_, ny_ = std::lround(y1 / s_) + 1 - oy_;
    nz_ = std::lround(z1 / s_) + 1 - oz_;
    blocked_.assign(static_cast<std::size_t>(nx_ * ny_ * nz_), true);
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      if (tree.isNodeOccupied(*leaf)) continue;
      const double half = leaf.getSize() / 2;
      const long ax = std::lround((leaf.getX() - half) / s_), n = std::lround(leaf.getSize() / s_);
      const long ay = std::lround((leaf.getY() - half) / s_);
      const long az = std::lround((leaf.getZ() - half) / s_);
      for (long z = az; z < az + n; ++z)
        for (long y = ay; y < ay + n; ++y)
          for (long x = ax; x < ax + n; ++x) blocked_[place(x, y, z)] = false;
    }
  }

  double voxel_size() const { return s_; }

  bool blocked(long x, long y, long z) const {
    if (x < ox_ || y < oy_ || z < oz_ || x >= ox_ + nx_ || y >= oy_ + ny_ || z >= oz_ + nz_)
      return true;
    return blocked_[place(x, y, z)];
  }

  /// Distance from a point to the nearest blocked cube, or `reach` where none is nearer.
  double distance(const Vec& p, double reach) const {
    double best = reach * reach;
    const auto low = [&](double v) { return static_cast<long>(std::floor((v - reach) / s_)); };
    const auto high = [&](double v) { return static_cast<long>(std::floor((v + reach) / s_)); };
    const auto off = [&](long i, double v) {
      const double a = static_cast<double>(i) * s_;
      return v < a ? a - v : v > a + s_ ? v - a - s_ : 0.0;
    };
    for (long z = low(p.z); z <= high(p.z); ++z)
      for (long y = low(p.y); y <= high(p.y); ++y) {
        const double dy = off(y, p.y), dz = off(z, p.z), beside = dy * dy + dz * dz;
        if (beside >= best) continue;
        for (long x = low(p.x); x <= high(p.x); ++x)
          if (blocked(x, y, z)) best = std::min(best, beside + off(x, p.x) * off(x, p.x));
      }
    return std::sqrt(best);
  }

 private:
  std::size_t place(long x, long y, long z) const {
    return static_cast<std::size_t>(((z - oz_) * ny_ + y - oy_) * nx_ + x - ox_);
  }

  double s_;
  long ox_ = 0, oy_ = 0, oz_ = 0, nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<bool> blocked_;
};

struct Verdict {
  std::size_t paths = 0, samples = 0, violations = 0;
  double smallest_margin = 1e9;  // metres, of distance over radius; at most one voxel is looked at
};

void judge(const Grid& grid, const nlohmann::json& path, Verdict& verdict) {
  const double radius = path.at("radius").get<double>();
  std::vector<Vec> points;
  for (const auto& w : path.at("waypoints"))
    points.push_back({w.at(0).get<double>(), w.at(1).get<double>(), w.at(2).get<double>()});
  if (points.empty()) throw std::runtime_error("a path without waypoints");
  ++verdict.paths;
  bool bad = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec a = points[i], b = points[std::min(i + 1, points.size() - 1)];
    const double length = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
    const int n = static_cast<int>(length / grid.voxel_size() * kSamplesPerVoxel) + 1;
    for (int k = 0; k < n; ++k) {
      const double t = static_cast<double>(k) / n;
      const Vec p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
      const double margin = grid.distance(p, radius + grid.voxel_size()) - radius;
      verdict.smallest_margin = std::min(verdict.smallest_margin, margin);
      bad |= margin < -kSlack;
      ++verdict.samples;
    }
  }
  verdict.violations += bad;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::runtime_error("usage: path_oracle MAP.bt PATHS.json");
  octomap::OcTree tree(0.1);
  if (!tree.readBinary(argv[1])) throw std::runtime_error(std::string("cannot read ") + argv[1]);
  const Grid grid(tree);
  std::ifstream file(argv[2]);
  Verdict verdict;
  for (const auto& path : nlohmann::json::parse(file)) judge(grid, path, verdict);
  std::printf(
      "{\"paths\": %zu, \"samples\": %zu, \"violations\": %zu, \"smallest_margin\": %.9f}\n",
      verdict.paths, verdict.samples, verdict.violations, verdict.smallest_margin);
  return verdict.violations == 0 && verdict.paths > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "path_oracle: error: %s\n", error.what());
  return 2;
}
