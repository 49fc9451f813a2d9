// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "pictures/scatter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

TEST(Scatter, ALineHasGapsWhereThereIsNoValue) {
  const TemporaryFolder folder;
  const auto lines_to = [&](double third) {
    ScatterChart chart;
    chart.title = "stages";
    chart.log_y = true;
    chart.series = {{"field", {{1, 1}, {2, 2}, {3, third}, {4, 1}, {5, 3}}, SeriesStyle::kLine}};
    draw_scatter(chart, folder / "chart.svg");
    const std::string svg = read_whole(folder / "chart.svg");
    // The line comes before its legend; a gap begins it anew.
    const std::size_t line = svg.find("fill:none;stroke-width:2;");
    const std::size_t begin = svg.find(" d=\"", line) + 4;
    const std::string path = svg.substr(begin, svg.find('"', begin) - begin);
    return std::pair(std::count(path.begin(), path.end(), 'M'),
                     std::count(path.begin(), path.end(), 'L'));
  };
  EXPECT_EQ(lines_to(2.0), std::pair(1L, 4L));
  EXPECT_EQ(lines_to(kGap), std::pair(2L, 2L));
}

TEST(Scatter, WithoutAnyValueThereIsNoChart) {
  const TemporaryFolder folder;
  ScatterChart chart;
  chart.series = {{"nothing", {{1, kGap}}, SeriesStyle::kLine}};
  EXPECT_NE(refusal([&] { draw_scatter(chart, folder / "chart.svg"); }).find("has no points"),
            std::string::npos);
}

}  // namespace
}  // namespace ridgeway
