// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corrected_scans.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::size_t kFewFrames = 2;  // that the updating thread may as well fuse itself
constexpr int kMostRounds = 8;  // scans that come faster than they are fused are not waited for

void sort_each_once(std::vector<std::uint32_t>& frames) {
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
}

void keep_first_of_lost(std::vector<std::uint32_t>& frames, std::size_t first_kept) {
  const auto kept = std::lower_bound(frames.begin(), frames.end(), first_kept);
  if (kept - frames.begin() > 1) frames.erase(frames.begin() + 1, kept);
}

}  // namespace

void FrameIndex::add(const Eigen::Isometry3d& pose, std::span<const BlockIndex> reached,
                     std::size_t first_kept) {
  const auto frame = static_cast<std::uint32_t>(poses.size());
  poses.push_back(pose);
  for (const BlockIndex& block : reached) {
    std::vector<std::uint32_t>& own = of_block[block];
    if (own.size() == own.capacity()) keep_first_of_lost(own, first_kept);  // before it grows
    own.push_back(frame);
  }
}

void FrameIndex::drop_last(std::span<const BlockIndex> reached, std::size_t frames) noexcept {
  for (const BlockIndex& block : reached)
    if (const auto own = of_block.find(block); own != of_block.end())
      while (!own->second.empty() && own->second.back() >= frames) own->second.pop_back();
  while (poses.size() > frames) poses.pop_back();
}

Correction::Correction(const FusionConfig& fusion, const ScanLog& log, const FrameIndex& frames,
                       std::vector<Eigen::Isometry3d> poses)
    : fusion_(fusion), log_(log), scans_{frames, {}, TsdfFusion()} {
  fusion_.origin = frames.origin;
  in_background([this, poses = std::move(poses)] { fuse_again(poses); });
}

Correction::~Correction() {
  is_given_up_ = true;
  if (work_.valid()) work_.wait();
}

/// With one thread: the others are for those who update and plan.
template <typename Work>
void Correction::in_background(Work work) {
  work_ = std::async(std::launch::async,
                     [work = std::move(work)]() mutable { with_threads(1, [&] { work(); }); });
  ++rounds_;
}

bool Correction::is_ready(const FrameIndex& now) {
  if (failure_ || !work_.valid()) return true;
  if (work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  const std::size_t later = now.poses.size() - scans_.frames.poses.size();
  if (later <= kFewFrames || rounds_ == kMostRounds) return true;
  try {
    std::vector<std::uint32_t> frames = note_later_frames(now);
    in_background([this, before = std::move(work_), frames = std::move(frames)]() mutable {
      before.get();
      fuse_all(frames);
    });
  } catch (...) {  // some of it may be noted, and what was done before is lost
    failure_ = std::current_exception();
    return true;
  }
  return false;
}

CorrectedScans& Correction::finished(const FrameIndex& now) {
  if (failure_) std::rethrow_exception(failure_);
  if (work_.valid()) work_.get();
  fuse_all(note_later_frames(now));
  return scans_;
}

void Correction::fuse_again(const std::vector<Eigen::Isometry3d>& poses) {
  FrameIndex& index = scans_.frames;
  std::vector<std::uint32_t> moved;
  for (std::uint32_t frame = 0; frame < poses.size(); ++frame)
    if (poses[frame].matrix() != index.poses[frame].matrix()) moved.push_back(frame);
  index.poses = poses;
  const auto has_moved = [&](std::uint32_t frame) {
    return std::binary_search(moved.begin(), moved.end(), frame);
  };
  for (auto& [block, of_block] : index.of_block)
    if (std::erase_if(of_block, has_moved) > 0) scans_.redone.insert(block);
  for (const std::uint32_t frame : moved) {
    TsdfFusion probe(fusion_);
    fuse(probe, frame);
    for (const BlockIndex& block : probe.reached_blocks()) {
      std::vector<std::uint32_t>& of_block = index.of_block[block];
      of_block.insert(std::lower_bound(of_block.begin(), of_block.end(), frame), frame);
      scans_.redone.insert(block);
    }
  }
  std::vector<std::uint32_t> needed = moved;
  for (const BlockIndex& block : scans_.redone) {
    const std::vector<std::uint32_t>& of_block = index.of_block[block];
    needed.insert(needed.end(), of_block.begin(), of_block.end());
  }
  sort_each_once(needed);
  scans_.part = TsdfFusion(fusion_).within_blocks(
      std::vector<BlockIndex>(scans_.redone.begin(), scans_.redone.end()));
  fuse_all(needed);
}

/// Of the frames that have come since the last that is known here, those which reach blocks that
/// are fused again.
std::vector<std::uint32_t> Correction::note_later_frames(const FrameIndex& now) {
  FrameIndex& index = scans_.frames;
  const std::size_t known = index.poses.size();
  std::vector<std::uint32_t> needed;
  for (const auto& [block, of_block] : now.of_block) {
    const auto later = std::lower_bound(of_block.begin(), of_block.end(), known);
    if (later == of_block.end()) continue;
    std::vector<std::uint32_t>& own = index.of_block[block];
    own.insert(own.end(), later, of_block.end());
    if (scans_.redone.contains(block)) needed.insert(needed.end(), later, of_block.end());
  }
  index.poses.insert(index.poses.end(), now.poses.begin() + static_cast<std::ptrdiff_t>(known),
                     now.poses.end());
  sort_each_once(needed);
  return needed;
}

/// Fuses a frame of the log, unless all is given up.
void Correction::fuse(TsdfFusion& fusion, std::uint32_t frame) const {
  if (is_given_up_) return;
  try {
    if (frame < log_.first())
      throw InputError("log", "no longer holds this scan", "give log_bytes that hold more");
    const LoggedScan scan = log_.read(frame);
    if (scan.is_image)
      fusion.integrate(scan.image, scan.camera, scans_.frames.poses[frame]);
    else
      fusion.integrate(scan.points, scans_.frames.poses[frame]);
  } catch (const InputError& error) {
    throw error.within("frame " + std::to_string(frame + 1));
  }
}

void Correction::fuse_all(const std::vector<std::uint32_t>& frames) {
  for (const std::uint32_t frame : frames) fuse(scans_.part, frame);
}

}  // namespace ridgeway::detail
