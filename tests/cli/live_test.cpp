// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>

#include "program.hpp"

namespace ridgeway {
namespace {

const std::string kRecording = std::string(RIDGEWAY_DATA_DIR) + "/house_depth";

class CliLive : public Program {};

TEST_F(CliLive, ReplaysARecordingThatABatchBuildVerifies) {
  const Outcome outcome =
      run({"live", kRecording, "-o", path("live.ridge"), "--voxel-size", "0.2", "--min-clearance",
           "0.3", "--max-distance", "3", "--verify", "10", "--csv", path("live.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = outcome.json();
  const auto frames = json["frames"].get<std::size_t>();
  EXPECT_GT(frames, 10u);
  EXPECT_GE(json["verified"].get<std::size_t>(), frames / 10 - 1);
  EXPECT_GT(json["vertices"].get<std::size_t>(), 10u);
  EXPECT_TRUE(json["total_ms"].contains("median"));
  const std::string csv = read_whole(folder_ / "live.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), frames + 1);
  EXPECT_EQ(run({"check", path("live.ridge"), "--queries", "20"}).code, 0);
}

TEST_F(CliLive, RefusesWhatIsNoRecordingAndNamesTheFrame) {
  EXPECT_EQ(run({"live", path("nowhere"), "-o", path("live.ridge")}).code, 1);
  // A robot that fits nowhere.
  const Outcome outcome = run({"live", kRecording, "-o", path("live.ridge"), "--voxel-size", "0.5",
                               "--min-clearance", "5"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("--min-clearance"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ridgeway
