// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "world_generators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "common/random.hpp"
#include "common/require.hpp"

namespace ridgeway {
namespace {

using detail::require;

using Vector = Eigen::Vector3d;

/// Six planes around the open box from the origin to a corner.
std::vector<SolidPlane> room(const Vector& size) {
  std::vector<SolidPlane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes.push_back({Vector::Unit(axis), 0.0});
    planes.push_back({-Vector::Unit(axis), -size[axis]});
  }
  return planes;
}

SolidBox box_between(const Point& low, const Point& high) {
  return {0.5 * (low + high), high - low};
}

// --- the maze
// -------------------------------------------------------------------------------------

/// The walls between the cells of a square: across x (between a cell and the next one along x) and
/// across y. True where the wall stands.
class MazeWalls {
 public:
  explicit MazeWalls(int cells)
      : cells_(cells), across_{std::vector<bool>(area(), true), std::vector<bool>(area(), true)} {}

  bool stands(int axis, int x, int y) const { return across_[side(axis)][place(x, y)]; }
  void open(int axis, int x, int y) { across_[side(axis)][place(x, y)] = false; }

  /// Opens walls until every cell is reached from the first by one way (depth first).
  void carve(Random& random) {
    std::vector<bool> seen(area(), false);
    std::vector<std::array<int, 2>> way{{0, 0}};
    seen[0] = true;
    while (!way.empty()) {
      const auto [x, y] = way.back();
      std::array<std::array<int, 2>, 4> next;
      std::size_t count = 0;
      for (const auto& [dx, dy] : kSteps) {
        const int nx = x + dx, ny = y + dy;
        if (nx >= 0 && ny >= 0 && nx < cells_ && ny < cells_ && !seen[place(nx, ny)])
          next[count++] = {nx, ny};
      }
      if (count == 0) {
        way.pop_back();
        continue;
      }
      const auto [nx, ny] = next[random.below(count)];
      open(nx == x ? 1 : 0, std::min(x, nx), std::min(y, ny));
      seen[place(nx, ny)] = true;
      way.push_back({nx, ny});
    }
  }

  /// Takes out some of the walls that still stand.
  void open_more(int count, Random& random) {
    for (int tries = 0; count > 0 && tries < 1000 * cells_; ++tries) {
      const int axis = static_cast<int>(random.below(2));
      const auto along = static_cast<int>(random.below(static_cast<std::uint64_t>(cells_ - 1)));
      const auto beside = static_cast<int>(random.below(static_cast<std::uint64_t>(cells_)));
      const int x = axis == 0 ? along : beside, y = axis == 0 ? beside : along;
      if (!stands(axis, x, y)) continue;
      open(axis, x, y);
      --count;
    }
  }

 private:
  static constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::size_t area() const { return static_cast<std::size_t>(cells_ * cells_); }
  std::size_t place(int x, int y) const { return static_cast<std::size_t>(y * cells_ + x); }
  static std::size_t side(int axis) { return static_cast<std::size_t>(axis); }

  int cells_;
  std::array<std::vector<bool>, 2> across_;
};

/// Boxes for the walls across an axis, one for each unbroken run.
void add_walls(const MazeWalls& walls, const MazeConfig& config, int axis, World& world) {
  for (int along = 0; along + 1 < config.cells; ++along) {
    const auto stands = [&](int beside) {
      return beside < config.cells &&
             (axis == 0 ? walls.stands(0, along, beside) : walls.stands(1, beside, along));
    };
    for (int first = 0; first < config.cells; ++first) {
      if (!stands(first)) continue;
      int end = first + 1;
      while (stands(end)) ++end;
      Point low, high;
      low[axis] = (along + 1) * config.cell - 0.5 * config.wall;
      high[axis] = low[axis] + config.wall;
      low[1 - axis] = first * config.cell - 0.5 * config.wall;  // fills the corners
      high[1 - axis] = end * config.cell + 0.5 * config.wall;
      low.z() = 0.0;
      high.z() = config.height;
      world.boxes.push_back(box_between(low, high));
      first = end;
    }
  }
}

// --- the hall
// -------------------------------------------------------------------------------------

/// Finds places on the floor that keep a distance from one another.
class FloorPlan {
 public:
  FloorPlan(double length, double width, Random& random)
      : length_(length), width_(width), random_(random) {}

  void occupy(const SolidBox& box) { taken_.push_back(box); }

  /// The centre of a free rectangle of a size, as far up as half its height; false if there is
  /// hardly any.
  bool find(const Vector& size, Point& centre) {
    constexpr double kAisle = 1.2;  // metres left to walk and fly
    for (int tries = 0; tries < 200; ++tries) {
      centre = {random_.uniform(kAisle + 0.5 * size.x(), length_ - kAisle - 0.5 * size.x()),
                random_.uniform(kAisle + 0.5 * size.y(), width_ - kAisle - 0.5 * size.y()),
                0.5 * size.z()};
      const bool is_free = std::none_of(taken_.begin(), taken_.end(), [&](const SolidBox& box) {
        const Vector gap = (centre - box.centre).cwiseAbs() - 0.5 * (size + box.size);
        return gap.head<2>().maxCoeff() < kAisle;
      });
      if (!is_free) continue;
      taken_.push_back({centre, size});
      return true;
    }
    return false;
  }

 private:
  double length_, width_;
  Random& random_;
  std::vector<SolidBox> taken_;
};

void add_columns(const HallConfig& config, World& world, FloorPlan& plan) {
  constexpr double kSpacing = 5.0, kSide = 0.4;
  const int across = static_cast<int>(config.length / kSpacing);
  const int along = static_cast<int>(config.width / kSpacing);
  for (int i = 1; i < across; ++i)
    for (int k = 1; k < along; ++k) {
      const Point centre(i * config.length / across, k * config.width / along, 0.5 * config.height);
      world.boxes.push_back({centre, {kSide, kSide, config.height}});
      plan.occupy(world.boxes.back());
    }
}

/// A floor half way up along the wall x = length, on posts.
void add_mezzanine(const HallConfig& config, World& world, FloorPlan& plan) {
  constexpr double kDepth = 3.0, kThickness = 0.2, kPost = 0.12, kSpacing = 3.0;
  const double level = 0.5 * config.height, end = 0.7 * config.width;
  const Point low(config.length - kDepth, 0.0, level), high(config.length, end, level + kThickness);
  world.boxes.push_back(box_between(low, high));
  plan.occupy(world.boxes.back());
  for (double y = 0.5 * kSpacing; y < end; y += kSpacing)
    world.cylinders.push_back({{low.x() + kPost, y, 0.5 * level}, kPost, level});
}

void add_crane(const HallConfig& config, World& world, Random& random) {
  const double y = random.uniform(0.2, 0.8) * config.width;
  const double x = random.uniform(0.2, 0.8) * config.length;
  const double top = config.height - 0.2;
  world.boxes.push_back(
      {{0.5 * config.length, y, top - 0.25}, {config.length, 0.5, 0.5}});  // the bridge
  world.boxes.push_back({{x, y, top - 0.75}, {1.0, 0.8, 0.5}});            // the trolley
  world.boxes.push_back({{x, y, top - 1.3}, {0.15, 0.15, 0.6}});           // the hook
}

void add_pipes(const HallConfig& config, World& world, Random& random) {
  for (int i = 0; i < config.pipes; ++i) {
    const double side = random.uniform(0.1, 0.3), z = config.height - random.uniform(0.2, 0.7);
    if (i % 2 == 0)
      world.boxes.push_back({{0.5 * config.length, random.uniform(0.5, config.width - 0.5), z},
                             {config.length, side, side}});
    else
      world.boxes.push_back({{random.uniform(0.5, config.length - 0.5), 0.5 * config.width, z},
                             {side, config.width, side}});
  }
}

void add_tanks_and_machines(const HallConfig& config, World& world, FloorPlan& plan,
                            Random& random) {
  Point centre;
  for (int i = 0; i < config.tanks; ++i) {
    const double radius = random.uniform(0.5, 1.2), height = random.uniform(0.4, 0.7);
    const Vector size(2.0 * radius, 2.0 * radius, height * config.height);
    if (plan.find(size, centre)) world.cylinders.push_back({centre, radius, size.z()});
  }
  for (int i = 0; i < config.machines; ++i) {
    Vector size;  // in an order of our own: that of arguments is the compiler's choice
    size.z() = random.uniform(0.8, 2.2);
    size.y() = random.uniform(0.8, 2.0);
    size.x() = random.uniform(0.8, 2.5);
    if (plan.find(size, centre)) world.boxes.push_back({centre, size});
  }
}

}  // namespace

void MazeConfig::validate() const {
  require(cells >= 2 && cells <= 1000, "maze cells", cells, "give 2 to 1000");
  require(wall > 0.0 && std::isfinite(wall), "maze wall", wall, "give metres above 0");
  require(cell > wall && std::isfinite(cell), "maze cell", cell, "give metres, more than a wall");
  require(height > 0.0 && std::isfinite(height), "maze height", height, "give metres above 0");
  require(extra_openings >= 0, "maze extra_openings", extra_openings, "give 0 or more");
}

World make_maze(const MazeConfig& config) {
  config.validate();
  Random random(config.seed);
  MazeWalls walls(config.cells);
  walls.carve(random);
  walls.open_more(config.extra_openings, random);
  World world;
  world.name = "maze " + std::to_string(config.seed);
  world.planes = room({config.cells * config.cell, config.cells * config.cell, config.height});
  add_walls(walls, config, 0, world);
  add_walls(walls, config, 1, world);
  return world;
}

void HallConfig::validate() const {
  require(length >= 10.0 && std::isfinite(length), "hall length", length, "give 10 metres or more");
  require(width >= 10.0 && std::isfinite(width), "hall width", width, "give 10 metres or more");
  require(height >= 4.0 && std::isfinite(height), "hall height", height, "give 4 metres or more");
  require(tanks >= 0, "hall tanks", tanks, "give 0 or more");
  require(machines >= 0, "hall machines", machines, "give 0 or more");
  require(pipes >= 0, "hall pipes", pipes, "give 0 or more");
}

World make_hall(const HallConfig& config) {
  config.validate();
  Random random(config.seed);
  FloorPlan plan(config.length, config.width, random);
  World world;
  world.name = "hall " + std::to_string(config.seed);
  world.planes = room({config.length, config.width, config.height});
  add_columns(config, world, plan);
  add_mezzanine(config, world, plan);
  add_crane(config, world, random);
  add_pipes(config, world, random);
  add_tanks_and_machines(config, world, plan, random);
  return world;
}

}  // namespace ridgeway
