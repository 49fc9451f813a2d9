// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/benchmark_scenarios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "files/read_file.hpp"
#include "formats/benchmark_map.hpp"
#include "planning/lattice_search.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {
namespace {

constexpr double kHalfACell = 0.5;

EsdfMap benchmark_esdf(std::string_view bytes) {
  return compute_esdf(read_benchmark_map(bytes, "map", 1.0));
}

detail::LatticePath search(const EsdfMap& esdf, const VoxelIndex& start, const VoxelIndex& goal) {
  return detail::search_lattice(esdf, esdf.layout.find(start), esdf.layout.find(goal), kHalfACell,
                                {}, detail::Deadline(1e9));
}

std::string scenario_refusal(std::string_view bytes) {
  try {
    read_benchmark_scenarios(bytes, "a.3dscen");
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "a.3dscen");
    return error.what();
  }
  return "accepted";
}

TEST(BenchmarkScenarios, ReadsQueriesAndOptima) {
  const BenchmarkScenarios read = read_benchmark_scenarios(
      "version 1\nA.3dmap\n1 2 3 4 5 6 5.19615242 1.000\r\n\n0 0 0 0 0 0 0 1\n", "a.3dscen");
  EXPECT_EQ(read.map, "A.3dmap");
  ASSERT_EQ(read.scenarios.size(), 2u);
  EXPECT_EQ(read.scenarios[0].start, (VoxelIndex{1, 2, 3}));
  EXPECT_EQ(read.scenarios[0].goal, (VoxelIndex{4, 5, 6}));
  EXPECT_EQ(read.scenarios[0].optimal_length, 5.19615242);
  EXPECT_TRUE(read_benchmark_scenarios("version 1\nA.3dmap\n", "a.3dscen").scenarios.empty());
}

TEST(BenchmarkScenarios, NamesTheLineThatIsBad) {
  for (const char* bytes : {"", "version 2\nA\n", "Version 1\nA\n", "version 1 1\nA\n"})
    EXPECT_NE(scenario_refusal(bytes), "accepted") << bytes;
  EXPECT_NE(scenario_refusal("version 2\nA\n").find("line 1"), std::string::npos);
  EXPECT_NE(scenario_refusal("version 1\n\n").find("line 2"), std::string::npos);
  EXPECT_NE(scenario_refusal("version 1\nA B\n").find("line 2"), std::string::npos);
  for (const char* line : {"1 2 3 4 5 6 7", "1 2 3 4 5 6 7 8 9", "1 2 -3 4 5 6 7 1",
                           "1 2 3 4 5 6 nan 1", "1 2 3 4 5 6 inf 1", "1 2 3 4 5 6 -7 1",
                           "1 2 3 4 5.5 6 7 1", "1 2 3 4 5 6 7 x", "1 2 3 4 5 99999999999 7 1"}) {
    const std::string what =
        scenario_refusal("version 1\nA\n1 1 1 2 1 1 1 1\n" + std::string(line) + "\n");
    EXPECT_NE(what.find("line 4"), std::string::npos) << line << ": " << what;
  }
}

TEST(BenchmarkMaps, RefuseWhatDoesNotBeginAsOne) {
  for (const std::string_view bytes :
       {std::string_view(""), std::string_view("\1\0v\177", 4), std::string_view("voxel"),
        std::string_view("voxels 2 2 2\n"), std::string_view("voxel 2 2\n")})
    EXPECT_THROW(benchmark_esdf(bytes), InputError) << bytes;
}

TEST(BenchmarkScenarios, MovesCutNoCornersAndStayOnTheGrid) {
  // One blocked cell beside a diagonal; a column of cells at the very edge.
  const EsdfMap esdf = benchmark_esdf("voxel 3 3 3\n1 0 0\n1 1 1\n");
  const double r2 = std::sqrt(2.0);
  EXPECT_NEAR(search(esdf, {0, 0, 0}, {1, 1, 0}).cost, 2.0, 1e-12);
  EXPECT_NEAR(search(esdf, {0, 1, 0}, {1, 2, 0}).cost, r2, 1e-12);
  EXPECT_NEAR(search(esdf, {0, 0, 0}, {2, 0, 0}).cost, 4.0, 1e-12);
  EXPECT_NEAR(search(esdf, {0, 2, 2}, {2, 0, 2}).cost, 2.0 * r2, 1e-12);
  EXPECT_NEAR(search(esdf, {0, 0, 1}, {2, 2, 1}).cost, 4.0, 1e-12);
  const EsdfMap corridor = benchmark_esdf("voxel 1 1 9\n");
  EXPECT_NEAR(search(corridor, {0, 0, 0}, {0, 0, 8}).cost, 8.0, 1e-12);
}

/// The first `count` stored optima of a map, each reproduced by A* through the ESDF.
void expect_stored_optima(const std::filesystem::path& map, std::size_t count) {
  SCOPED_TRACE(map.string());
  const EsdfMap esdf = benchmark_esdf(read_file(map));
  const std::string file = map.string() + ".3dscen";
  const BenchmarkScenarios stored = read_benchmark_scenarios(read_file(file), file);
  ASSERT_EQ(stored.map, map.filename());
  ASSERT_GE(stored.scenarios.size(), count);
  std::vector<double> costs(count);
  parallel_for_each_index(count, [&](std::size_t i) {
    costs[i] = search(esdf, stored.scenarios[i].start, stored.scenarios[i].goal).cost;
  });
  for (std::size_t i = 0; i < count; ++i)  // the files keep eight decimals
    EXPECT_NEAR(costs[i], stored.scenarios[i].optimal_length,
                1e-6 * stored.scenarios[i].optimal_length)
        << "scenario " << i;
}

TEST(BenchmarkScenarios, AStarReproducesTheBundledOptima) {
  expect_stored_optima(std::filesystem::path(RIDGEWAY_DATA_DIR) / "warframe/Simple.3dmap", 250);
}

/// Where RIDGEWAY_MAPS names a folder with the benchmarks somewhere below.
TEST(BenchmarkScenarios, AStarReproducesTheOptimaOfWholeBenchmarks) {
  const char* folder = std::getenv("RIDGEWAY_MAPS");
  std::size_t maps = 0;
  if (folder != nullptr && std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".3dmap" ||
          !std::filesystem::exists(entry.path().string() + ".3dscen"))
        continue;
      expect_stored_optima(entry.path(), 200);
      ++maps;
    }
  }
  if (maps == 0) GTEST_SKIP() << "no .3dmap with a .3dscen below RIDGEWAY_MAPS";
}

}  // namespace
}  // namespace ridgeway
