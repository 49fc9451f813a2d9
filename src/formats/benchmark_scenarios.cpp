// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "benchmark_scenarios.hpp"

#include <cmath>
#include <optional>

#include "files/byte_reader.hpp"
#include "files/text.hpp"

namespace ridgeway {
namespace {

/// The next three words of a line, whole numbers from 0 up.
std::optional<VoxelIndex> take_waypoint(std::string_view& line) {
  const auto x = to_number<int>(take_word(line)), y = to_number<int>(take_word(line)),
             z = to_number<int>(take_word(line));
  if (!x || !y || !z || *x < 0 || *y < 0 || *z < 0) return std::nullopt;
  return VoxelIndex{*x, *y, *z};
}

std::optional<BenchmarkScenario> scenario_of(std::string_view line) {
  const auto start = take_waypoint(line), goal = take_waypoint(line);
  const auto length = to_number<double>(take_word(line)),
             ratio = to_number<double>(take_word(line));
  if (!start || !goal || !length || !ratio || !take_word(line).empty() ||
      !(*length >= 0.0 && std::isfinite(*length)))
    return std::nullopt;
  return BenchmarkScenario{*start, *goal, *length};
}

}  // namespace

BenchmarkScenarios read_benchmark_scenarios(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  std::string_view version = reader.take_line();
  if (take_word(version) != "version" || take_word(version) != "1" || !take_word(version).empty())
    throw InputError(name, "line 1 is not \"version 1\"", "give a .3dscen file of that version");
  std::string_view map = reader.take_line();
  BenchmarkScenarios result{.map = std::string(take_word(map)), .scenarios = {}};
  if (result.map.empty() || !take_word(map).empty())
    throw InputError(name, "line 2 is not the name of a map", "give one word, such as A1.3dmap");
  for (std::size_t line_number = 3; reader.remaining() > 0; ++line_number) {
    std::string_view line = reader.take_line();
    if (const auto scenario = scenario_of(line)) {
      result.scenarios.push_back(*scenario);
    } else if (!take_word(line).empty()) {
      throw InputError(name, "line " + std::to_string(line_number) + " is not a scenario",
                       "give the cells of start and goal, the optimal length and the ratio");
    }
  }
  return result;
}

}  // namespace ridgeway
