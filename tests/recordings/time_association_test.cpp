// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "recordings/time_association.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ridgeway {
namespace {

/// Of all pairs that are left the nearest in time, again and again.
std::vector<std::optional<std::size_t>> associate_plainly(const std::vector<double>& images,
                                                          const std::vector<double>& poses,
                                                          double longest_gap) {
  std::vector<std::optional<std::size_t>> pose_of(images.size());
  std::vector<bool> is_taken(poses.size());
  for (;;) {
    double least = longest_gap;
    std::optional<std::pair<std::size_t, std::size_t>> nearest;
    for (std::size_t i = 0; i < images.size(); ++i)
      for (std::size_t k = 0; k < poses.size(); ++k)
        if (const double gap = std::abs(images[i] - poses[k]);
            !pose_of[i] && !is_taken[k] && gap <= least) {
          least = gap;
          nearest = {i, k};
        }
    if (!nearest) return pose_of;
    pose_of[nearest->first] = nearest->second;
    is_taken[nearest->second] = true;
  }
}

TEST(TimeAssociation, TakesTheNearestPairsFirstAndEachPoseOnce) {
  std::size_t paired = 0, left = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> time(0.0, 3.0);
    std::vector<double> images(random() % 12), poses(random() % 12);
    for (double& t : images) t = time(random);
    for (double& t : poses) t = time(random);
    const double longest_gap = 0.1 + 0.4 * (seed % 3);
    const auto pose_of = associate(images, poses, longest_gap);
    ASSERT_EQ(pose_of, associate_plainly(images, poses, longest_gap));
    for (const auto& pose : pose_of) ++(pose ? paired : left);
  }
  EXPECT_GT(paired, 500u);
  EXPECT_GT(left, 200u);
}

}  // namespace
}  // namespace ridgeway
