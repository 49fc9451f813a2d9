// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/common/error.hpp"

namespace ridgeway::testing {

/// Calls a stage with a callback that stops it the so many-th time it is asked, from 0 on.
template <typename Stage>
void expect_cancelled_at(int stop, const Stage& stage) {
  int calls = 0;
  const Progress until_stop = [&](std::string_view, double share) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    return calls++ < stop;
  };
  EXPECT_THROW(stage(until_stop), Cancelled) << stop;
  EXPECT_EQ(calls, stop + 1);  // never asked again
}

/// Stops a stage at each of the places where it can be stopped; returns how many there are.
template <typename Stage>
int places_to_stop(const Stage& stage) {
  int places = 0;
  stage([&](std::string_view, double) {
    ++places;
    return true;
  });
  for (int stop = 0; stop < places; ++stop) expect_cancelled_at(stop, stage);
  return places;
}

/// Stops a stage that is made of others at the beginning of each of them; returns how many there
/// are. It may be asked within them, too, as often as time allows.
template <typename Stage>
int stages_to_stop(const Stage& stage) {
  std::vector<std::string> names;
  stage([&](std::string_view name, double) {
    if (names.empty() || names.back() != name) names.emplace_back(name);
    return true;
  });
  for (const std::string& stop : names) {
    bool is_stopped = false;
    const Progress until_stop = [&](std::string_view name, double) {
      EXPECT_FALSE(is_stopped) << "asked again at " << name;
      is_stopped = name == stop;
      return !is_stopped;
    };
    EXPECT_THROW(stage(until_stop), Cancelled) << stop;
  }
  return static_cast<int>(names.size());
}

}  // namespace ridgeway::testing
