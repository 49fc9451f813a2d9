// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>

#include "shell_memory.hpp"

namespace ridgeway::detail {

/// How a diagram was made last: what the stages that make it keep of a map that changes.
class DiagramMemory {
 public:
  /// Blocks may have come since; the levels of these voxels alone may be others. `slots`: the
  /// blocks that hold some of them. Changes add up until forget_changes().
  void change(const BlockLayout& layout, const VoxelMask& changed,
              std::span<const std::uint32_t> slots) {
    changed_.grow(layout);
    for (const std::uint32_t slot : slots)
      for (std::size_t z = 0; z < kBlockSide; ++z)
        changed_.block(slot)[z] |= changed.block(slot)[z];
  }
  /// The diagram has been made of the map as it is.
  void forget_changes() { changed_ = {}; }
  /// The voxels whose level may be another than when the diagram was made last.
  const VoxelMask& changed() const { return changed_; }

  ShellMemory shells;  ///< of edges and joined kernel

 private:
  VoxelMask changed_;
};

}  // namespace ridgeway::detail
