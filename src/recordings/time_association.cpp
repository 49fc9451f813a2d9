// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "time_association.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

namespace ridgeway {
namespace {

/// The nearest pair of those left are always neighbours in time.
class Association {
 public:
  Association(std::span<const double> images, std::span<const double> poses, double longest_gap)
      : longest_gap_(longest_gap), pose_of_(images.size()) {
    for (std::size_t i = 0; i < images.size(); ++i) stamps_.push_back({images[i], false, i});
    for (std::size_t k = 0; k < poses.size(); ++k) stamps_.push_back({poses[k], true, k});
    std::sort(stamps_.begin(), stamps_.end(), [](const Stamp& a, const Stamp& b) {
      return std::tie(a.time, a.is_pose, a.place) < std::tie(b.time, b.is_pose, b.place);
    });
    const std::size_t count = stamps_.size();
    for (std::size_t i = 0; i < count; ++i) {
      stamps_[i].previous = i == 0 ? kNone : i - 1;
      stamps_[i].next = i + 1 == count ? kNone : i + 1;
    }
    for (std::size_t i = 0; i < count; ++i) offer(i, stamps_[i].next);
  }

  std::vector<std::optional<std::size_t>> run() {
    while (!pairs_.empty()) {
      const Pair nearest = pairs_.top();
      pairs_.pop();
      take(nearest);
    }
    return std::move(pose_of_);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Stamp {
    double time;
    bool is_pose;
    std::size_t place;  // among the images, or the poses
    std::size_t previous = kNone, next = kNone;
    bool is_taken = false;
  };
  struct Pair {
    double gap;
    std::size_t left, right;
    bool operator>(const Pair& other) const {
      return std::tie(gap, left) > std::tie(other.gap, other.left);
    }
  };

  void offer(std::size_t left, std::size_t right) {
    if (left == kNone || right == kNone || stamps_[left].is_pose == stamps_[right].is_pose) return;
    const double gap = stamps_[right].time - stamps_[left].time;
    if (gap <= longest_gap_) pairs_.push({gap, left, right});
  }

  void take(const Pair& pair) {
    Stamp &left = stamps_[pair.left], &right = stamps_[pair.right];
    if (left.is_taken || right.is_taken) return;
    left.is_taken = right.is_taken = true;
    pose_of_[left.is_pose ? right.place : left.place] = left.is_pose ? left.place : right.place;
    if (left.previous != kNone) stamps_[left.previous].next = right.next;
    if (right.next != kNone) stamps_[right.next].previous = left.previous;
    offer(left.previous, right.next);
  }

  double longest_gap_;
  std::vector<std::optional<std::size_t>> pose_of_;
  std::vector<Stamp> stamps_;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> pairs_;
};

}  // namespace

std::vector<std::optional<std::size_t>> associate(std::span<const double> images,
                                                  std::span<const double> poses,
                                                  double longest_gap) {
  return Association(images, poses, longest_gap).run();
}

}  // namespace ridgeway
