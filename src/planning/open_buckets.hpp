// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway::detail {

/// Open voxels in buckets of nearly equal estimates, which only grow: no heap to climb. Inside a
/// bucket the order is free, so a voxel may be taken before its best cost is known and once more
/// after; that is rare and costs less than sorting.
class OpenBuckets {
 public:
  struct Entry {
    double cost;
    VoxelId voxel;
  };

  explicit OpenBuckets(double least_estimate) : least_(least_estimate) {}

  void push(double estimate, const Entry& entry) {
    const auto place = static_cast<std::size_t>(std::max(estimate - least_, 0.0) / kWidth);
    if (place >= buckets_.size()) buckets_.resize(place + 1);
    buckets_[std::max(place, current_)].push_back(entry);
  }

  /// The next entry, none of a bucket whose estimates are all at or above `bound`.
  std::optional<Entry> pop(double bound) {
    while (current_ < buckets_.size() && buckets_[current_].empty()) {
      buckets_[current_].shrink_to_fit();
      ++current_;
    }
    if (current_ >= buckets_.size() || least_ + kWidth * static_cast<double>(current_) >= bound)
      return std::nullopt;
    const Entry entry = buckets_[current_].back();
    buckets_[current_].pop_back();
    return entry;
  }

 private:
  static constexpr double kWidth = 0.25;  // voxels
  const double least_;
  std::size_t current_ = 0;
  std::vector<std::vector<Entry>> buckets_;
};

}  // namespace ridgeway::detail
