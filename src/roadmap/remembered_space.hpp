// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// What FreeSpace said of segments in a map that changes: an answer holds as long as nothing has
/// changed where it was looked for. Answers that were not asked for between two changes are
/// forgotten. Any number of threads may ask, one tells of changes.
class SegmentMemory {
 public:
  /// All that is asked from now on is of the map after a change. `changed`: the blocks in which an
  /// obstacle, a distance or a site is another than before, and those that were added.
  void change(const BlockLayout& layout, std::span<const std::uint32_t> changed);
  /// Forgets what was not asked for since the last change.
  void forget_unasked();
  /// Nothing is known any more.
  void forget();

  /// The answer to a question, or what `find` gives. `low` and `high`: corners of the box, voxels,
  /// that holds all that the answer depends on.
  template <typename Find>
  double answer(const std::array<double, 7>& question, const Point& low, const Point& high,
                const Find& find) {
    Shard& shard = shards_[hash_of_question(question) % kShards];
    {
      const std::lock_guard lock(shard.mutex);
      if (const auto known = shard.now.find(question); known != shard.now.end())
        return known->second;
      if (const auto known = shard.before.find(question);
          known != shard.before.end() && !touches_change(low, high)) {
        const double value = known->second;
        shard.now.insert(shard.before.extract(known));
        return value;
      }
    }
    const double value = find();
    const std::lock_guard lock(shard.mutex);
    if (shard.now.size() < most_answers_) shard.now.emplace(question, value);
    return value;
  }

 private:
  using Question = std::array<double, 7>;
  static std::size_t hash_of_question(const Question& question) noexcept;
  struct Hash {
    std::size_t operator()(const Question& question) const noexcept {
      return hash_of_question(question);
    }
  };
  using Answers = std::unordered_map<Question, double, Hash>;
  static constexpr std::size_t kShards = 32;
  struct Shard {
    std::mutex mutex;
    Answers now, before;
  };

  bool touches_change(const Point& low, const Point& high) const;
  std::uint32_t sum_up_to(int x, int y, int z) const;

  std::array<Shard, kShards> shards_;
  std::size_t most_answers_ = 0;  // of a shard: memory follows the map
  // How many changed blocks there are up to each one of the box around them.
  BlockIndex low_{}, extent_{};
  std::vector<std::uint32_t> sums_;
};

/// FreeSpace, with a memory or without.
class RememberedSpace {
 public:
  RememberedSpace(const EsdfMap& esdf, SegmentMemory* memory)
      : esdf_(esdf), space_(esdf), memory_(memory) {}

  bool is_free(const Point& a, const Point& b, double radius) const;
  double clearance(const Point& a, const Point& b) const;
  /// Or `at_most` where it is larger.
  double clearance(const Point& a, const Point& b, double at_most) const;
  SquaredHalves move_clearance(VoxelId from, VoxelId to, int direction) const;

 private:
  template <typename Find>
  double ask(double kind, const Point& a, const Point& b, double reach, const Find& find) const;
  double farthest_obstacle(const Point& p) const;

  const EsdfMap& esdf_;
  const FreeSpace space_;
  SegmentMemory* const memory_;
};

}  // namespace ridgeway::detail
