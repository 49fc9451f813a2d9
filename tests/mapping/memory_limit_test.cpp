// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mapping/memory_limit.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr std::uint64_t kGigabyte = 1'000'000'000;

TEST(MemoryLimit, PageCacheOfTheControlGroupCountsAsAvailable) {
  // A container of 8 GB that has read 7 GB of files and holds 0.5 GB of its own.
  const MemoryReadings readings = {
      .meminfo = "MemTotal: 64000000 kB\nMemFree: 100 kB\nMemAvailable: 32000000 kB\n",
      .group_limit = "8000000000\n",
      .group_used = "7500000000\n",
      .group_stat =
          "anon 500000000\nfile 7000000000\ninactive_anon 9\n"
          "inactive_file 4000000000\nactive_file 2900000000\nslab_reclaimable 100000000\n"
          "slab 100000000\n"};
  EXPECT_EQ(available_memory_bytes(readings), 8 * kGigabyte - kGigabyte / 2);
}

TEST(MemoryLimit, IsTheLeastOfWhatMachineGroupAndProcessLeave) {
  const MemoryReadings machine = {.meminfo = "MemAvailable:    2000000 kB\n"};
  EXPECT_EQ(available_memory_bytes(machine), 2'048'000'000u);
  MemoryReadings group = machine;
  group.group_limit = "max\n";
  group.group_used = "5\n";
  EXPECT_EQ(available_memory_bytes(group), 2'048'000'000u);
  group.group_limit = "1000000000\n";
  group.group_used = "400000000\n";
  EXPECT_EQ(available_memory_bytes(group), 600'000'000u);
  group.group_used = "1000000001\n";
  EXPECT_EQ(available_memory_bytes(group), 0u);
  MemoryReadings process = machine;
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  process.process_used = "1000 70 3 1 0 9 0\n";
  process.process_limit = 5000 * page;
  EXPECT_EQ(available_memory_bytes(process), 4000 * page);
  process.process_limit = 10;
  EXPECT_EQ(available_memory_bytes(process), 0u);
}

TEST(MemoryLimit, WhatCannotBeReadIsNoLimit) {
  EXPECT_EQ(available_memory_bytes(MemoryReadings{}), std::uint64_t{1} << 63);
  const MemoryReadings strange = {.meminfo = "MemAvailable\n\nMemAvailable: lots\n",
                                  .group_limit = "-",
                                  .group_used = "",
                                  .group_stat = "inactive_file",
                                  .process_used = "?"};
  EXPECT_EQ(available_memory_bytes(strange), std::uint64_t{1} << 63);
}

TEST(MemoryLimit, RefusalsNameTheMapAndTheRemedyInWordsOfTheLibrary) {
  EXPECT_NO_THROW(require_memory_for_blocks(1.0, kPipelineBytesPerVoxel, "map"));
  try {
    require_memory_for_blocks(1e15, kPipelineBytesPerVoxel, "hall.bt");
    FAIL() << "1e15 blocks were granted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "hall.bt");
    EXPECT_EQ(error.remedy().find("--"), std::string::npos) << error.remedy();
  }
}

}  // namespace
}  // namespace ridgeway
