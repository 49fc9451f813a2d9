// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kBatch = 64;  // queries between two reports of progress

using Scenarios = std::vector<GridScenario>;

void require_scenarios(const GridBenchmark& benchmark) {
  const std::string where = "map '" + benchmark.map + "'";
  if (benchmark.scenarios.empty()) throw InputError(where, "has no scenarios", "give at least one");
  for (std::size_t i = 0; i < benchmark.scenarios.size(); ++i)
    if (const double optimum = benchmark.scenarios[i].optimum;
        !(optimum > 0.0 && std::isfinite(optimum)))
      throw InputError(where,
                       "has the optimum " + number_text(optimum) + " in scenario " + number_text(i),
                       "give lengths above 0");
}

/// At most `most` places in a list, evenly spread from the first on.
std::vector<std::size_t> spread_places(std::size_t count, std::size_t most) {
  const std::size_t taken = most == 0 ? count : std::min(count, most);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < taken; ++i) places.push_back(i * count / taken);
  return places;
}

void report(const Progress& progress, std::string_view stage, std::size_t done, std::size_t of) {
  if (progress && !progress(stage, static_cast<double>(done) / static_cast<double>(of)))
    throw Cancelled();
}

GridAnswers answer(const Roadmap& roadmap, const Scenarios& scenarios, bool shorten,
                   double optimum_accuracy, const Progress& progress) {
  GridAnswers answers;
  std::vector<double> solved, microseconds;
  for (const GridScenario& scenario : scenarios) {
    if (answers.ratios.size() % kBatch == 0)
      report(progress, shorten ? "graph" : "graph, not shortened", answers.ratios.size(),
             scenarios.size());
    const PlanResult result = plan(roadmap, scenario.start, scenario.goal, {.shorten = shorten});
    microseconds.push_back(result.seconds.total * 1e6);
    answers.ratios.push_back(result.ok() ? result.length / scenario.optimum
                                         : std::numeric_limits<double>::quiet_NaN());
    if (!result.ok()) continue;
    ++answers.solved;
    answers.fallbacks += result.answered_by != Planner::kGraph;
    answers.within_violations += answers.ratios.back() > result.within * (1.0 + optimum_accuracy);
    solved.push_back(answers.ratios.back());
  }
  answers.length_over_optimum = spread_of(std::move(solved));
  answers.microseconds = spread_of(std::move(microseconds));
  return answers;
}

/// Lengths of A* through the ESDF; NaN where it finds no path.
std::vector<double> exact_lengths(const Roadmap& roadmap, const Scenarios& scenarios,
                                  const Progress& progress) {
  std::vector<double> lengths(scenarios.size());
  for (std::size_t first = 0; first < lengths.size(); first += kBatch) {
    report(progress, "esdf", first, lengths.size());
    parallel_for_each_index(std::min(kBatch, lengths.size() - first), [&](std::size_t k) {
      const GridScenario& scenario = scenarios[first + k];
      const PlanResult result = plan(roadmap, scenario.start, scenario.goal,
                                     {.planner = Planner::kEsdf, .shorten = false});
      lengths[first + k] = result.ok() ? result.length : std::numeric_limits<double>::quiet_NaN();
    });
  }
  return lengths;
}

}  // namespace

void GridExperimentConfig::validate() const {
  if (!(min_clearance > 0.0 && std::isfinite(min_clearance)))
    throw InputError("min_clearance", "is " + number_text(min_clearance), "give metres, above 0");
  if (!(optimum_accuracy >= 0.0 && optimum_accuracy < 1.0))
    throw InputError("optimum_accuracy", "is " + number_text(optimum_accuracy),
                     "give a share of the optimum, from 0 to below 1");
}

GridRow run_grid(GridBenchmark benchmark, const GridExperimentConfig& config,
                 const Progress& progress) {
  config.validate();
  require_scenarios(benchmark);
  GridRow row;
  row.map = benchmark.map;
  row.scenarios = spread_places(benchmark.scenarios.size(), config.scenarios);
  Scenarios scenarios;
  for (const std::size_t place : row.scenarios) scenarios.push_back(benchmark.scenarios[place]);

  const BuildResult built =
      build_roadmap(std::move(benchmark.voxels), {.min_clearance = config.min_clearance}, progress);
  const Roadmap& roadmap = built.roadmap;
  row.build_seconds = built.report.seconds.total;
  row.vertices = roadmap.graph.vertices.size();
  row.edges = roadmap.graph.edges.size();
  row.raw = answer(roadmap, scenarios, false, config.optimum_accuracy, progress);
  row.shortened = answer(roadmap, scenarios, true, config.optimum_accuracy, progress);

  Scenarios unsolved;
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    if (std::isnan(row.shortened.ratios[i])) unsolved.push_back(scenarios[i]);
  row.solvable = row.shortened.solved;
  for (const double length : exact_lengths(roadmap, unsolved, progress))
    row.solvable += !std::isnan(length);

  row.optimum_checked = std::min(config.exact, scenarios.size());
  const Scenarios checked(scenarios.begin(),
                          scenarios.begin() + static_cast<std::ptrdiff_t>(row.optimum_checked));
  const std::vector<double> lengths = exact_lengths(roadmap, checked, progress);
  for (std::size_t i = 0; i < checked.size(); ++i)
    row.optimum_reproduced +=
        std::abs(lengths[i] - checked[i].optimum) <= config.optimum_accuracy * checked[i].optimum;
  return row;
}

}  // namespace ridgeway
