// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/build_record.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ridgeway {
namespace {

TEST(BuildRecord, TellsHowTheRidgesWereFound) {
  const BuildConfig config{.min_clearance = 0.3, .theta = 1.25, .least_apart = 0.6};
  const GvdConfig read = gvd_of_record(build_record(config, 0.1).dump());
  EXPECT_EQ(read.theta, 1.25);
  EXPECT_EQ(read.least_apart, 0.6);
}

TEST(BuildRecord, OfOthersHasTheDefaults) {
  for (const char* record :
       {"", "no json", "[1]", "{}", R"({"theta": "wide", "least_apart": null})"}) {
    const GvdConfig read = gvd_of_record(record);
    EXPECT_EQ(read.theta, GvdConfig().theta) << record;
    EXPECT_EQ(read.least_apart, GvdConfig().least_apart) << record;
  }
}

TEST(BuildRecord, HasLimitsWhereThereAreSome) {
  BuildConfig config;
  EXPECT_FALSE(build_record(config, 0.1).contains("limits"));
  config.limits.keep_out.push_back({Point(0, 1, 2), Point(3, 4, 5)});
  const nlohmann::ordered_json record = build_record(config, 0.1);
  EXPECT_EQ(record["limits"]["keep_out"][0], nlohmann::ordered_json({0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(record["limits"]["keep_in"][0].is_null());
}

}  // namespace
}  // namespace ridgeway
