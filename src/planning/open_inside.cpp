// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "open_inside.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ridgeway::detail {

std::span<const int> faces_of(const EsdfMap& esdf) {
  static constexpr std::array kFaces{10, 12, 14, 16, 4, 22};
  return std::span(kFaces).first(esdf.planar ? 4 : 6);
}

OpenInside::OpenInside(const EsdfMap& esdf, VoxelId from)
    : esdf_(esdf),
      box_(known_range({.voxel_size = esdf.voxel_size,
                        .origin = esdf.origin,
                        .layout = esdf.layout,
                        .state = esdf.state.shared()})),
      first_(block_of(box_.min)),
      last_(block_of(box_.max)),
      voxels_(esdf.layout) {
  double blocks = 1.0;
  for (const int side : {last_.x - first_.x, last_.y - first_.y, last_.z - first_.z})
    blocks *= side + 1.0;
  // A bit for each takes no more memory than a byte for each voxel of the map.
  if (blocks <= 8.0 * static_cast<double>(esdf.layout.voxel_count()))
    blocks_.resize(static_cast<std::size_t>(blocks));
  reach(esdf.layout.index_of(from));
  for (std::size_t i = 0; i < queue_.size() || !open_blocks_.empty();) {
    if (!open_blocks_.empty()) {
      const BlockIndex block = open_blocks_.back();
      open_blocks_.pop_back();
      cross(block);
      continue;
    }
    const VoxelIndex here = esdf.layout.index_of(queue_[i++]);
    for (const int d : faces_of(esdf)) reach(here + offset_of(d));
  }
}

bool OpenInside::reaches(const VoxelIndex& voxel) const {
  if (!box_.contains(voxel)) return false;
  const VoxelId id = esdf_.layout.find(voxel);
  if (id != kNoVoxel) return voxels_.test(id);
  return !blocks_.empty() && blocks_[place_of(block_of(voxel))];
}

void OpenInside::reach(const VoxelIndex& voxel) {
  if (!box_.contains(voxel)) {
    if (!way_out_) way_out_ = voxel;
    return;
  }
  const VoxelId id = esdf_.layout.find(voxel);
  if (id == kNoVoxel) return reach_block(block_of(voxel), voxel);
  if (esdf_.state[id] == VoxelState::kOccupied || voxels_.test(id)) return;
  voxels_.set(id);
  queue_.push_back(id);
}

void OpenInside::reach_block(const BlockIndex& block, const VoxelIndex& from) {
  if (blocks_.empty()) {
    if (!way_out_) way_out_ = from;
    return;
  }
  const std::size_t place = place_of(block);
  if (blocks_[place]) return;
  blocks_[place] = true;
  open_blocks_.push_back(block);
}

/// From a block that is not allocated to all voxels beside it.
void OpenInside::cross(const BlockIndex& block) {
  const VoxelIndex low = voxel_of(block, 0), high = voxel_of(block, kBlockVoxels - 1);
  // Of the block what lies in the box: it is a box too.
  const VoxelIndex first{std::max(low.x, box_.min.x), std::max(low.y, box_.min.y),
                         std::max(low.z, box_.min.z)};
  const VoxelIndex last{std::min(high.x, box_.max.x), std::min(high.y, box_.max.y),
                        std::min(high.z, box_.max.z)};
  for (const int d : faces_of(esdf_)) {
    const VoxelIndex o = offset_of(d);
    const auto side = [](int from, int to, int step) {
      return std::pair(step > 0 ? to : from, step < 0 ? from : to);
    };
    const auto x = side(first.x, last.x, o.x);
    const auto y = side(first.y, last.y, o.y);
    const auto z = side(first.z, last.z, o.z);
    for (int k = z.first; k <= z.second; ++k)
      for (int j = y.first; j <= y.second; ++j)
        for (int i = x.first; i <= x.second; ++i) reach(VoxelIndex{i, j, k} + o);
  }
}

std::size_t OpenInside::place_of(const BlockIndex& block) const {
  const auto width = static_cast<std::size_t>(last_.x - first_.x + 1);
  const auto depth = static_cast<std::size_t>(last_.y - first_.y + 1);
  return static_cast<std::size_t>(block.x - first_.x) +
         width * (static_cast<std::size_t>(block.y - first_.y) +
                  depth * static_cast<std::size_t>(block.z - first_.z));
}

}  // namespace ridgeway::detail
