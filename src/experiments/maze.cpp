// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "maze.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/asking.hpp"
#include "common/clock.hpp"
#include "common/random.hpp"
#include "common/require.hpp"
#include "exploration_flight.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"
#include "sensing/poses.hpp"

namespace ridgeway {
namespace {

constexpr double kLeastRound = 0.1;  // seconds that each planner plans in a round

struct Pair {
  Point start, goal;
};

/// Throws Cancelled where the callback says so in the middle of a long one.
using Plan = std::function<PlanResult(const Pair&, const Progress&)>;

struct Contender {
  std::string name;
  Plan plan;
  bool is_slow = false;  ///< takes all of its time
};

Plan on_roadmap(const Roadmap& roadmap, Planner planner, bool shorten) {
  return [&roadmap, planner, shorten](const Pair& pair, const Progress&) {
    return plan(roadmap, pair.start, pair.goal, {.planner = planner, .shorten = shorten});
  };
}

Plan quickly(const Roadmap& roadmap) {
  return [&roadmap](const Pair& pair, const Progress&) {
    return plan(roadmap, pair.start, pair.goal, {.quick = true});
  };
}

Plan by_sampling(const Roadmap& roadmap, const MazeExperimentConfig& config, Planner planner,
                 bool first_solution) {
  return [&roadmap, &config, planner, first_solution](const Pair& pair, const Progress& progress) {
    const SamplingConfig sampling{.planner = planner,
                                  .radius = config.min_clearance,
                                  .seed = config.seed,
                                  .time_limit = config.time_limit,
                                  .first_solution = first_solution,
                                  .shorten = false,
                                  .range = config.range};
    return plan_by_sampling(roadmap.esdf, pair.start, pair.goal, sampling, progress).plan;
  };
}

std::vector<Contender> contenders(const Roadmap& roadmap, const MazeExperimentConfig& config) {
  return {{"rrtstar", by_sampling(roadmap, config, Planner::kRrtStar, true)},
          {"rrtstar_10s", by_sampling(roadmap, config, Planner::kRrtStar, false), true},
          {"rrtconnect", by_sampling(roadmap, config, Planner::kRrtConnect, true)},
          {"esdf", on_roadmap(roadmap, Planner::kEsdf, false)},
          {"diagram", on_roadmap(roadmap, Planner::kDiagram, false)},
          {"graph_raw", on_roadmap(roadmap, Planner::kGraph, false)},
          {"graph_quick", quickly(roadmap)},
          {"graph", on_roadmap(roadmap, Planner::kGraph, true)}};
}

/// What a drone has mapped that needs the clearance, a voxel of it margin, when it has seen all.
OccupancyMap explored_map(const World& world, const MazeExperimentConfig& config,
                          const Point& start, const Progress& progress) {
  ExplorationFlightConfig flight;
  flight.start = start;
  flight.voxel_size = config.voxel_size;
  flight.radius = std::max(0.5 * config.min_clearance, config.min_clearance - config.voxel_size);
  flight.margin = config.min_clearance - flight.radius;
  flight.come_back = false;
  flight.sensor.camera = {
      .width = 160, .height = 120, .fx = 80.0, .fy = 80.0, .cx = 79.5, .cy = 59.5};
  flight.sensor.range_sigma = 0.01;
  flight.seed = config.seed;
  return explore(world, flight, progress).map;
}

/// The middles of the first and the last cell.
Pair corners(const MazeConfig& maze) {
  const double near = 0.5 * maze.cell, far = (maze.cells - 0.5) * maze.cell;
  return {Point(near, near, 0.5 * maze.height), Point(far, far, 0.5 * maze.height)};
}

std::vector<Pair> random_pairs(const World& world, const MazeExperimentConfig& config) {
  const PoseSampling inside = sampling_inside(world);
  Random random(config.seed);
  const auto place = [&] {
    for (;;) {  // a maze has room: its generator refuses cells that are all wall
      Point p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = random.uniform(inside.low[axis], inside.high[axis]);
      if (surface_distance(world, p).distance >= config.min_clearance + config.voxel_size) return p;
    }
  };
  std::vector<Pair> pairs;
  while (pairs.size() < config.pairs) {
    const Point start = place();
    pairs.push_back({start, place()});
  }
  return pairs;
}

/// One query's answer, and how long it took in every round.
struct Trial {
  PlanResult answer;
  std::vector<double> seconds;

  void run(const Plan& plan, const Pair& pair, const Progress& progress) {
    answer = plan(pair, progress);
    seconds.push_back(answer.seconds.total);
  }
  double median_seconds() const { return spread_of(seconds).median; }
};

struct Trials {
  Trial single;
  std::vector<Trial> pairs;
};

/// All pairs, over and over for a while: what takes microseconds is timed among its like, not
/// while it fetches from memory what another planner displaced. Throws Cancelled.
void run_round(const Contender& contender, const Pair& single, const std::vector<Pair>& pairs,
               const Progress& progress, Trials& trials) {
  const double end = detail::seconds_now() + kLeastRound;
  detail::Asking asking(progress);
  trials.pairs.resize(pairs.size());
  do {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      asking.go_on(contender.name, 0.0);
      trials.pairs[i].run(contender.plan, pairs[i], progress);
    }
    trials.single.run(contender.plan, single, progress);
  } while (detail::seconds_now() < end);
}

/// Throws Cancelled.
std::vector<double> lengths_by_esdf(const Roadmap& roadmap, const std::vector<Pair>& pairs,
                                    const Progress& progress) {
  detail::Asking asking(progress);
  std::vector<double> lengths;
  lengths.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    asking.go_on("esdf", 0.0);
    lengths.push_back(
        plan(roadmap, pair.start, pair.goal, {.planner = Planner::kEsdf, .shorten = false}).length);
  }
  return lengths;
}

MazeRow row_of(const Contender& contender, const Trials& trials,
               const std::vector<double>& esdf_lengths) {
  MazeRow row;
  row.planner = contender.name;
  row.queries = trials.pairs.size();
  std::vector<double> seconds, lengths, vertices, ratios;
  for (std::size_t i = 0; i < trials.pairs.size(); ++i) {
    const PlanResult& answer = trials.pairs[i].answer;
    if (!answer.ok()) continue;
    ++row.solved;
    seconds.push_back(trials.pairs[i].median_seconds());
    lengths.push_back(answer.length);
    vertices.push_back(static_cast<double>(answer.waypoints.size()));
    ratios.push_back(answer.length / esdf_lengths[i]);
  }
  row.seconds = spread_of(std::move(seconds));
  row.length = spread_of(std::move(lengths));
  row.vertices = spread_of(std::move(vertices));
  row.length_over_esdf = spread_of(std::move(ratios));
  if (const PlanResult& answer = trials.single.answer; answer.ok()) {
    row.single_seconds = trials.single.median_seconds();
    row.single_length = answer.length;
    row.single_vertices = answer.waypoints.size();
    row.single_path = answer.waypoints;
  }
  return row;
}

}  // namespace

void MazeExperimentConfig::validate() const {
  maze.validate();
  using detail::require;
  require(voxel_size > 0.0 && std::isfinite(voxel_size), "voxel_size", voxel_size,
          "give metres, above 0");
  require(2.0 * (min_clearance + voxel_size) < std::min(maze.cell - maze.wall, maze.height),
          "min_clearance", min_clearance, "give a radius that fits into the maze's corridors");
  require(min_clearance > 0.0, "min_clearance", min_clearance, "give metres, above 0");
  require(time_limit > 0.0, "time_limit", time_limit, "give seconds, above 0");
  require(repeat >= 1, "repeat", repeat, "give 1 or more");
}

MazeResult run_maze(const MazeExperimentConfig& config, const Progress& progress) {
  MazeResult result;
  run_maze(config, progress, result);
  return result;
}

void run_maze(const MazeExperimentConfig& config, const Progress& progress, MazeResult& result) {
  config.validate();
  const World world = make_maze(config.maze);
  const PoseSampling inside = sampling_inside(world);
  result = {};
  const Pair single = corners(config.maze);
  OccupancyMap map = config.explored
                         ? explored_map(world, config, single.start, progress)
                         : occupancy_of(world, config.voxel_size, {inside.low, inside.high});
  result.roadmap =
      build_roadmap(std::move(map), {.min_clearance = config.min_clearance}, progress).roadmap;
  const std::vector<Pair> pairs = random_pairs(world, config);
  const std::vector<double> esdf_lengths = lengths_by_esdf(result.roadmap, pairs, progress);
  const std::vector<Contender> all = contenders(result.roadmap, config);
  std::vector<Pair> few = pairs;
  few.resize(std::min(few.size(), config.long_pairs));
  std::vector<Trials> trials(all.size());
  for (std::size_t round = 0; round < config.repeat; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].is_slow && round > 0) continue;
      const double done = static_cast<double>(round * all.size() + i) /
                          static_cast<double>(config.repeat * all.size());
      const auto in_this_round = [&](std::string_view, double) {
        return !progress || progress(all[i].name, done);
      };
      run_round(all[i], single, all[i].is_slow ? few : pairs, in_this_round, trials[i]);
    }
    result.rows.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
      result.rows.push_back(row_of(all[i], trials[i], esdf_lengths));
  }
}

}  // namespace ridgeway
