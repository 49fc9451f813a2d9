// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "files/natural_order.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ridgeway {
namespace {

TEST(NaturalOrder, NumbersInNamesCountAsNumbers) {
  const std::vector<std::string> ordered = {"",
                                            "0.png",
                                            "1.png",
                                            "2.png",
                                            "10.png",
                                            "11.png",
                                            "99999999999999999999998.png",
                                            "99999999999999999999999.png",
                                            "a",
                                            "a01",
                                            "a1",
                                            "a1b",
                                            "a2",
                                            "a10",
                                            "a10b2",
                                            "a10b10",
                                            "b"};
  for (std::size_t i = 0; i < ordered.size(); ++i)
    for (std::size_t j = 0; j < ordered.size(); ++j)
      EXPECT_EQ(comes_before(ordered[i], ordered[j]), i < j) << ordered[i] << " " << ordered[j];
}

TEST(NaturalOrder, TheLastNumberOfANameIsFound) {
  EXPECT_EQ(last_number("frame-000004.depth"), 4);
  EXPECT_EQ(last_number("scan2_10"), 10);
  EXPECT_EQ(last_number("7"), 7);
  EXPECT_EQ(last_number("999999999999999999"), 999999999999999999);
  for (const char* none : {"", "depth", "9999999999999999999"})
    EXPECT_FALSE(last_number(none)) << none;
}

}  // namespace
}  // namespace ridgeway
