// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

TrajectoryResult some_result(int used_coefficients) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  TrajectoryResult result;
  result.status = TrajectoryStatus::kOk;
  for (int i = 0; i < 3; ++i) {
    TrajectorySegment segment;
    segment.duration = 1.0 + 0.5 * i;
    for (int k = 0; k < used_coefficients; ++k)
      for (int d = 0; d < kFlatOutputs; ++d) segment.coefficients(d, k) = value(random);
    result.trajectory.segments.push_back(segment);
  }
  result.duration = result.trajectory.duration();
  result.clearance = 0.4;
  return result;
}

TEST(TrajectoryIo, YamlHoldsEveryPieceToTheLastDigit) {
  for (const int count : {8, 10}) {
    const TrajectoryResult result = some_result(count);
    const YAML::Node segments = YAML::Load(trajectory_yaml(result.trajectory))["segments"];
    ASSERT_EQ(segments.size(), 3u);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const TrajectorySegment& expected = result.trajectory.segments[i];
      EXPECT_EQ(segments[i]["N"].as<int>(), count);
      EXPECT_EQ(segments[i]["D"].as<int>(), 4);
      EXPECT_EQ(segments[i]["time"].as<std::uint64_t>(),
                static_cast<std::uint64_t>(std::llround(expected.duration * 1e9)));
      ASSERT_EQ(segments[i]["coefficients"].size(), 4u);
      for (int d = 0; d < 4; ++d)
        for (int k = 0; k < count; ++k)
          EXPECT_EQ(segments[i]["coefficients"][d][k].as<double>(), expected.coefficients(d, k));
    }
  }
}

TEST(TrajectoryIo, YamlRefusesDurationsThatItCannotTell) {
  const TemporaryFolder folder;
  for (const double duration : {1e10, 1e-10}) {
    TrajectoryResult result = some_result(8);
    result.trajectory.segments.back().duration = duration;
    EXPECT_THROW(write_trajectory({}, result, folder / "flight.yaml", 1.0), InputError) << duration;
    EXPECT_FALSE(std::filesystem::exists(folder / "flight.yaml"));
  }
}

TEST(TrajectoryIo, CsvAndJsonHoldTheSameSamples) {
  const TrajectoryResult result = some_result(10);
  const auto states = result.trajectory.sample(0.1);
  std::istringstream csv(trajectory_csv(result.trajectory, 0.1));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "t,x,y,z,vx,vy,vz,ax,ay,az,yaw");
  PlanResult path;
  path.waypoints = {{0, 0, 0}, {1, 2, 3}};
  path.clearance = 0.5;
  const nlohmann::json json = nlohmann::json::parse(trajectory_json(path, result, 0.1));
  ASSERT_EQ(json["samples"].size(), states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const nlohmann::json& sample = json["samples"][i];
    EXPECT_EQ(sample["t"], states[i].time);
    EXPECT_EQ(sample["velocity"][1], states[i].velocity.y());
    EXPECT_EQ(sample["yaw"], states[i].yaw);
    ASSERT_TRUE(std::getline(csv, line));
    std::istringstream fields(line);
    std::vector<double> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(std::stod(field));
    ASSERT_EQ(values.size(), 11u);
    EXPECT_EQ(values[0], states[i].time);
    EXPECT_EQ(values[3], states[i].position.z());
    EXPECT_EQ(values[7], states[i].acceleration.x());
    EXPECT_EQ(values[10], states[i].yaw);
  }
  EXPECT_FALSE(std::getline(csv, line));
  EXPECT_EQ(json["waypoints"].size(), 2u);
  EXPECT_EQ(json["clearance"], 0.4);
  EXPECT_EQ(json["path_clearance"], 0.5);
  for (const char* key : {"answered_by", "status", "length", "duration", "max_speed",
                          "max_acceleration", "stop_and_go_duration", "step"})
    EXPECT_TRUE(json.contains(key)) << key;
}

TEST(TrajectoryIo, WritesByExtensionAndRefusesOthers) {
  const TemporaryFolder folder;
  const TrajectoryResult result = some_result(10);
  for (const char* name : {"a.csv", "a.json", "a.yaml"}) {
    write_trajectory({}, result, folder / name, 0.1);
    EXPECT_FALSE(read_whole(folder / name).empty());
  }
  EXPECT_THROW(write_trajectory({}, result, folder / "a.txt", 0.1), InputError);
  EXPECT_THROW(write_trajectory({}, result, folder / "none" / "a.csv", 0.1), InputError);
}

}  // namespace
}  // namespace ridgeway
