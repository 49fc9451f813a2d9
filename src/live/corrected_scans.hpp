// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <exception>
#include <future>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "scan_log.hpp"

namespace ridgeway::detail {

/// Which frames reached which blocks of the fusion, from which poses. Frames are counted from 0. Of
/// those that the log has lost a block may remember the first alone: it tells that the block cannot
/// be fused again, and lists do not grow for as long as a place is seen.
struct FrameIndex {
  VoxelIndex origin;                                                               ///< the fusion's
  std::vector<Eigen::Isometry3d> poses;                                            ///< by frame
  std::unordered_map<BlockIndex, std::vector<std::uint32_t>, BlockHash> of_block;  ///< ascending

  /// The log holds the frames from `first_kept` on.
  void add(const Eigen::Isometry3d& pose, std::span<const BlockIndex> reached,
           std::size_t first_kept);
  /// Takes back what add() has added, or a part of it.
  void drop_last(std::span<const BlockIndex> reached, std::size_t frames) noexcept;
};

/// Scans fused again from corrected poses.
struct CorrectedScans {
  FrameIndex frames;  ///< with the poses as corrected
  /// Blocks that frames which have moved reach now, or did before.
  std::unordered_set<BlockIndex, BlockHash> redone;
  TsdfFusion part;  ///< these blocks alone
};

/// A correction of poses that a thread of its own works on, with what stood when it began: the
/// frames, and the log, which must keep all of them until it ends.
class Correction {
 public:
  /// Begins. `poses`: those of all frames, as corrected.
  Correction(const FusionConfig& fusion, const ScanLog& log, const FrameIndex& frames,
             std::vector<Eigen::Isometry3d> poses);
  ~Correction();  ///< Gives it up, if it has not ended.
  Correction(const Correction&) = delete;
  Correction& operator=(const Correction&) = delete;

  /// Whether finished() need not wait for long: few frames have come since. Where many have, these
  /// are fused by the thread first.
  bool is_ready(const FrameIndex& now);

  /// Waits for it to end, with all frames that have come since it began. Throws InputError naming
  /// a frame that could not be fused.
  CorrectedScans& finished(const FrameIndex& now);

 private:
  void fuse_again(const std::vector<Eigen::Isometry3d>& poses);
  std::vector<std::uint32_t> note_later_frames(const FrameIndex& now);
  void fuse(TsdfFusion& fusion, std::uint32_t frame) const;
  void fuse_all(const std::vector<std::uint32_t>& frames);
  template <typename Work>
  void in_background(Work work);

  FusionConfig fusion_;
  const ScanLog& log_;
  CorrectedScans scans_;
  int rounds_ = 0;
  std::atomic<bool> is_given_up_ = false;
  std::future<void> work_;
  std::exception_ptr failure_;  ///< of is_ready(), which finished() tells
};

}  // namespace ridgeway::detail
