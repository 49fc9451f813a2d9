// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// A connected piece (over 26 neighbours) of the frontier in one block: free voxels with an unknown
/// one across a face. Voxels are the map's own.
struct FrontierPart {
  BlockIndex block;                 ///< of the map's own, which holds all of it
  VoxelIndex first;                 ///< the first of the free ones, which no other part has
  std::size_t voxels = 0;           ///< free ones
  std::vector<VoxelIndex> targets;  ///< unknown voxels across their faces, in (z, y, x) order
  Point centroid = Point::Zero();   ///< of the free voxels, metres, local frame
  /// Mean direction from the free voxels to the unknown ones, at most of length one: short where
  /// they lie on several sides.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::size_t cluster = 0;    ///< the connected piece of the whole frontier that this is a part of
  std::uint64_t version = 0;  ///< the update of the frontier in which it was made

  /// Equal in every field.
  friend bool operator==(const FrontierPart&, const FrontierPart&) = default;
};

/// A connected piece of the whole frontier.
struct FrontierCluster {
  std::size_t voxels = 0;                            ///< free ones
  Point centroid = Point::Zero();                    ///< metres, local frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< as of a part
  std::vector<std::size_t> parts;                    ///< ascending
};

/// Where what is known ends: kept block by block as a map changes. Only blocks with another state
/// than in the last update, and those beside what became known or unknown in them, are looked at
/// again; an update of nothing takes time linear in the blocks. Deterministic: the result is that
/// of an update from nothing.
class Frontiers {
 public:
  /// `within`: voxels of the lattice that count as unknown or free at all.
  explicit Frontiers(const VoxelRange& within = kAllVoxels) : within_(within) {}
  Frontiers(const Frontiers&) = delete;  // parts of blocks point to each other
  Frontiers& operator=(const Frontiers&) = delete;
  /// The one moved from can only be assigned to or destroyed.
  Frontiers(Frontiers&&) = default;
  /// The one moved from can only be assigned to or destroyed.
  Frontiers& operator=(Frontiers&&) = default;

  /// Follows the map. Keeps the roadmap until the next update, to compare with.
  void update(std::shared_ptr<const Roadmap> roadmap);

  /// Unknown voxels, the map's own, that count as known from the next update on: looked at in vain.
  void ignore(std::span<const VoxelIndex> voxels);

  /// By block in (z, y, x) order.
  std::span<const FrontierPart> parts() const { return parts_; }
  /// By their first part.
  std::span<const FrontierCluster> clusters() const { return clusters_; }
  /// Voxels of parts.
  std::size_t voxels() const;
  /// The blocks that had another state than before, in the last update.
  std::span<const BlockIndex> changed_blocks() const { return changed_; }
  /// Those of them in which a voxel was free and is no longer.
  std::span<const BlockIndex> closed_blocks() const { return closed_; }
  /// How many updates there have been.
  std::uint64_t version() const { return version_; }
  /// How many unknown voxels are ignored.
  std::size_t ignored() const { return ignored_count_; }

 private:
  struct Entry;
  /// A part of one block that touches a part of another, later in order.
  struct Link {
    std::uint32_t here = 0, there = 0;  ///< counted in their blocks
    const Entry* beyond = nullptr;
  };
  /// What is known of a block with a frontier in it.
  struct Entry {
    std::vector<VoxelMask::Block> pieces;  ///< the free voxels of each part
    std::vector<FrontierPart> made;        ///< in this update; else they are in parts_
    std::size_t first = 0;                 ///< in parts_
    std::vector<Link> links;
    std::uint64_t version = 0;  ///< the update in which it was made
  };

  std::vector<BlockIndex> find_changed(const Roadmap& now);
  void move_ignored(const VoxelIndex& by);
  void ignore(const VoxelIndex& voxel);
  VoxelMask::Block unknown_in(const BlockIndex& block) const;
  Entry entry_of(const BlockIndex& block) const;
  void replace(const BlockIndex& block, Entry entry);
  std::vector<FrontierPart> parts_in(const BlockIndex& block, Entry& entry) const;
  void link(const BlockIndex& block);
  static void link(Entry& entry, const Entry& beyond, const VoxelIndex& step);
  void gather();

  VoxelRange within_;
  std::shared_ptr<const Roadmap> roadmap_;
  std::map<BlockIndex, Entry> entries_;
  std::map<BlockIndex, VoxelMask::Block> ignored_;  ///< by block of the map's own
  std::vector<BlockIndex> stale_;                   ///< blocks with newly ignored voxels
  std::vector<BlockIndex> changed_, closed_;
  std::vector<FrontierPart> parts_;
  std::vector<FrontierCluster> clusters_;
  std::size_t ignored_count_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace ridgeway
