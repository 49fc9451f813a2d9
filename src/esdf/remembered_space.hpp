// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "changed_blocks.hpp"
#include "measured_moves.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {

/// What FreeSpace said of segments in a map that changes: an answer holds as long as no distance
/// and no site is another beside the segment, and no obstacle where it was looked for. Answers that
/// were not asked for between two changes are forgotten. Any number of threads may ask, one tells
/// of changes.
class SegmentMemory {
 public:
  /// All that is asked from now on is of the map after a change. `changed`: the blocks in which an
  /// obstacle, a distance or a site is another than before, and those that were added; `flipped`:
  /// those of them in which an obstacle is, or that were added.
  void change(const BlockLayout& layout, std::span<const std::uint32_t> changed,
              std::span<const std::uint32_t> flipped);
  /// Forgets what was not asked for since the last change.
  void forget_unasked();
  /// Nothing is known any more.
  void forget();

  /// A segment and a number that says what is asked of it.
  using OfSegment = std::array<double, 7>;

  /// The answer to a question, or what `find` gives. `holds(answer)`: whether the answer of before
  /// the last change still is right.
  template <typename Question, typename Holds, typename Find>
  double answer(const Question& question, const Holds& holds, const Find& find) {
    const std::uint64_t hash = hash_of(question);
    Shard& shard = shards_[(hash >> 32) % kShards];
    Answers<Question>& answers = std::get<Answers<Question>>(shard.answers);
    {
      const std::lock_guard lock(shard.mutex);
      if (const double* known = answers.now.find(question, hash)) return *known;
      if (const double* known = answers.before.find(question, hash); known && holds(*known)) {
        const double value = *known;
        keep(answers, question, hash, value);
        return value;
      }
    }
    const double value = find();
    const std::lock_guard lock(shard.mutex);
    // Another thread may have found it meanwhile.
    if (answers.now.find(question, hash) == nullptr) keep(answers, question, hash, value);
    return value;
  }

  /// The blocks in which anything has changed.
  const ChangedBlocks& changed() const { return changed_; }
  /// Those by slot, some maybe twice.
  const std::vector<std::uint32_t>& changed_slots() const { return changed_slots_; }
  /// Whether an answer of before the last change may be another now. The box around its segment,
  /// and how far from there it looked at obstacles, are in voxels.
  bool may_be_another(const Point& low, const Point& high, double reach) const;

 private:
  static constexpr std::size_t kShards = 32;
  template <typename Question>
  struct Answers {
    FlatTable<Question, double> now, before;
  };
  struct Shard {
    std::mutex mutex;
    std::tuple<Answers<OfSegment>, Answers<OfMove>> answers;
  };

  static std::uint64_t hash_of(const OfSegment& question) noexcept;
  static std::uint64_t hash_of(OfMove question) noexcept { return mixed(question); }

  template <typename Question>
  void keep(Answers<Question>& answers, const Question& question, std::uint64_t hash,
            double value) {
    if (answers.now.size() < most_answers_) answers.now.add(question, hash, value);
  }
  template <typename Body>
  void for_each_kind(const Body& body);

  std::array<Shard, kShards> shards_;
  std::size_t most_answers_ = 0;  // of a shard: memory follows the map
  ChangedBlocks changed_, flipped_;
  std::vector<std::uint32_t> changed_slots_;
};

/// FreeSpace, with a memory or without. `moves`: those that have been measured already.
class RememberedSpace {
 public:
  RememberedSpace(const EsdfMap& esdf, SegmentMemory* memory, const MeasuredMoves* moves = nullptr)
      : esdf_(esdf), space_(esdf), memory_(memory), moves_(moves) {}

  const EsdfMap& map() const { return esdf_; }
  SegmentMemory* memory() const { return memory_; }

  bool is_free(const Point& a, const Point& b, double radius) const;
  double clearance(const Point& a, const Point& b) const;
  /// Or `at_most` where it is larger.
  double clearance(const Point& a, const Point& b, double at_most) const;
  SquaredHalves move_clearance(VoxelId from, VoxelId to, int direction) const;
  /// Whether distances alone tell that a move is as wide as its narrower end.
  bool is_level(VoxelId from, VoxelId to, int direction) const {
    const SquaredHalves a = esdf_.squared[from], b = esdf_.squared[to];
    const SquaredHalves low = std::min(a, b);
    return low == SquaredHalves(kNoSite) ||
           FreeSpace::move_bound(a, b, squared_length(direction)) >= low;
  }
  /// Asks for the moves between members of a set where something has changed, so that others find
  /// them remembered: for a thread that would have nothing to do. Nothing without a memory.
  void remember_moves(const VoxelMask& voxels) const;

 private:
  template <typename Reach, typename Find>
  double ask(double kind, const Point& a, const Point& b, const Reach& reach,
             const Find& find) const;

  const EsdfMap& esdf_;
  const FreeSpace space_;
  SegmentMemory* const memory_;
  const MeasuredMoves* const moves_;
};

}  // namespace ridgeway::detail
