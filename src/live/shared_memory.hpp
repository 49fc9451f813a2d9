// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/roadmap/roadmap.hpp"
#include "touched_space.hpp"

/// What snapshots share: the memory of blocks that are the same in several of them.
namespace ridgeway::detail {

/// The same field in the same memory, which neither may write to from then on.
EsdfMap in_same_memory(const EsdfMap& esdf);

/// The same roadmap, without what is learnt, its fields in the same memory.
Roadmap in_same_memory(const Roadmap& roadmap);

/// The last attach field that was handed out.
struct LiveAttach {
  VoxelField<Direction> next = {};
};

/// The ways that the next attach field is made from: those of the last one in parts of space on
/// which nothing is built again, elsewhere `next`.
VoxelField<Direction> ways_to_build_on(LiveAttach& attach, const BlockLayout& layout,
                                       const VoxelField<Direction>& next,
                                       const VoxelMask& traversable, const TouchedSpace& space);

/// The field for a snapshot, built on `space`: in the memory of the last one where a block is the
/// same.
AttachField share(LiveAttach& attach, const TouchedSpace& space, AttachField now);

}  // namespace ridgeway::detail
