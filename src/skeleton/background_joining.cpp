// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "background_parts.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "simple_point.hpp"
#include "turns.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

using detail::BackgroundParts;

/// A voxel at which parts of the background may meet as the background grows level by level.
struct Contact {
  VoxelId id = kNoVoxel;
  Cube27 later = 0;
};

/// In the order in which voxels are peeled. Where two parts meet, the neighbours that are
/// background by then fall into parts of their own.
std::vector<Contact> find_contacts(const EsdfMap& esdf, const VoxelMask& voxels,
                                   const VoxelMask& not_simple) {
  const std::vector<VoxelId> ids = not_simple.members(esdf.layout);
  std::vector<Contact> contacts(ids.size());
  parallel_for_each_index(
      ids.size(),
      [&](std::size_t i) {
        const Cube27 later = detail::neighbours_by_level(esdf, voxels, ids[i]).later(ids[i]);
        if (background_parts(later) > 1) contacts[i] = {ids[i], later};
      },
      64);
  std::erase_if(contacts, [](const Contact& c) { return c.id == kNoVoxel; });
  const auto turn = [&](const Contact& c) {
    return std::tuple(esdf.squared[c.id], detail::sub_field(c.id), esdf.layout.order_of(c.id));
  };
  std::sort(contacts.begin(), contacts.end(),
            [&](const Contact& a, const Contact& b) { return turn(a) < turn(b); });
  return contacts;
}

/// Kruskal over the contacts, from the lowest up.
class BackgroundJoining {
 public:
  BackgroundJoining(const EsdfMap& esdf, VoxelMask& voxels)
      : esdf_(esdf), layout_(esdf.layout), voxels_(voxels), parts_(esdf.layout, voxels) {}

  bool has_nothing_to_join() const { return parts_.is_one(); }

  void join_at(const Contact& contact) {
    const std::vector<VoxelIndex> sides = different_sides(contact);
    if (sides.size() < 2 || !voxels_.test(contact.id)) return;
    const std::size_t begin = removed_.size();
    std::vector<std::uint32_t> parts;
    for (const VoxelIndex& side : sides) carve(side, parts);
    const Cube27 cube = cube_around(layout_, voxels_, contact.id);
    if (parts.size() < 2 || foreground_parts(cube) != 1 ||
        background_parts(cube) != static_cast<int>(parts.size()))
      return restore(begin);
    remove(contact.id, parts.front());
    for (const std::uint32_t part : parts) parts_.join(parts.front(), part);
  }

  /// All that was removed, to join one part with another.
  const std::vector<VoxelId>& removed() const { return removed_; }

 private:
  static constexpr std::uint32_t kNoPart = 0xffffffffu;

  /// Of each part of the neighbours that are background at a contact's turn the lowest one across
  /// a face, unless it is known to hang together with one before.
  std::vector<VoxelIndex> different_sides(const Contact& contact) {
    std::vector<VoxelIndex> sides;
    std::vector<std::uint32_t> parts;
    const Cube27 background = ~contact.later & kCells18;
    for (Cube27 left = background & kCells6; left != 0;) {
      const Cube27 part = flood6(left & (~left + 1), background);
      int lowest = std::countr_zero(part & left);
      for (Cube27 cells = part & left; cells != 0; cells &= cells - 1)
        if (const int d = std::countr_zero(cells);
            level_at(contact.id, d) < level_at(contact.id, lowest))
          lowest = d;
      left &= ~part;
      const VoxelIndex side = layout_.index_of(contact.id) + offset_of(lowest);
      const std::uint32_t number = part_below(side);
      if (number == kNoPart || std::find(parts.begin(), parts.end(), number) != parts.end())
        continue;
      parts.push_back(number);
      sides.push_back(side);
    }
    return sides;
  }

  /// Zero for what is background from the first.
  std::uint32_t level_at(VoxelId id, int direction) const {
    const VoxelId n = layout_.neighbour(id, direction);
    return n == kNoVoxel || !voxels_.test(n) ? 0 : esdf_.squared[n];
  }

  /// The part of the background that a voxel hangs together with below its level: that of its
  /// site, as all on the way there is lower.
  std::uint32_t part_below(const VoxelIndex& v) {
    const VoxelId id = layout_.find(v);
    if (id == kNoVoxel || !voxels_.test(id)) return part_at(v, id);
    if (esdf_.squared[id] == kNoSite) return kNoPart;
    const SiteOffset o = esdf_.site[id];
    return parts_.part_of(v + VoxelIndex{o.x, o.y, o.z});
  }

  /// That of a voxel of the background.
  std::uint32_t part_at(const VoxelIndex& v, VoxelId id) {
    const auto removed = part_of_removed_.find(id);
    return removed != part_of_removed_.end() ? parts_.find(removed->second) : parts_.part_of(v);
  }

  /// Removes an arc from the background up to a voxel, all of it simple when its turn comes, and
  /// notes which part it belongs to. Nothing is done where that cannot be, or the part is noted.
  void carve(const VoxelIndex& from, std::vector<std::uint32_t>& parts) {
    VoxelIndex at = from;
    VoxelId id = layout_.find(at);
    if (id != kNoVoxel && voxels_.test(id) && esdf_.squared[id] == kNoSite) return;
    SiteOffset left = id == kNoVoxel ? SiteOffset{} : esdf_.site[id];
    std::vector<VoxelId> arc;
    while (id != kNoVoxel && voxels_.test(id)) {
      arc.push_back(id);
      at = at + step_towards(left);
      id = layout_.find(at);
    }
    const std::uint32_t part = part_at(at, id);
    if (std::find(parts.begin(), parts.end(), part) != parts.end()) return;
    const std::size_t begin = removed_.size();
    for (std::size_t i = arc.size(); i-- > 0;) {
      if (!is_simple(cube_around(layout_, voxels_, arc[i]))) return restore(begin);
      remove(arc[i], part);
    }
    parts.push_back(part);
  }

  /// A step along the axis on which most is left, of which it is taken off.
  static VoxelIndex step_towards(SiteOffset& left) {
    const int x = std::abs(left.x), y = std::abs(left.y), z = std::abs(left.z);
    std::int16_t& most = z >= x && z >= y ? left.z : y >= x ? left.y : left.x;
    const int sign = most > 0 ? 1 : -1;
    const VoxelIndex step = &most == &left.x   ? VoxelIndex{sign, 0, 0}
                            : &most == &left.y ? VoxelIndex{0, sign, 0}
                                               : VoxelIndex{0, 0, sign};
    most = static_cast<std::int16_t>(most - sign);
    return step;
  }

  void remove(VoxelId id, std::uint32_t part) {
    voxels_.reset(id);
    removed_.push_back(id);
    part_of_removed_[id] = part;
  }

  /// Puts back all that was removed from one place in their list on.
  void restore(std::size_t begin) {
    for (; removed_.size() > begin; removed_.pop_back()) {
      voxels_.set(removed_.back());
      part_of_removed_.erase(removed_.back());
    }
  }

  const EsdfMap& esdf_;
  const BlockLayout& layout_;
  VoxelMask& voxels_;
  BackgroundParts parts_;
  std::vector<VoxelId> removed_;
  std::unordered_map<VoxelId, std::uint32_t> part_of_removed_;
};

/// What cannot go at its first turn among what is left, of voxels beside those that were removed.
void update_not_simple(const EsdfMap& esdf, const VoxelMask& voxels,
                       const std::vector<VoxelId>& removed, VoxelMask& not_simple) {
  for (const VoxelId id : removed) not_simple.reset(id);
  for (const VoxelId id : removed)
    for (Cube27 cube = cube_around(esdf.layout, voxels, id) & kCells26; cube != 0;
         cube &= cube - 1) {
      const VoxelId beside = esdf.layout.neighbour(id, std::countr_zero(cube));
      if (!is_simple(detail::neighbours_by_level(esdf, voxels, beside).later(beside)))
        not_simple.set(beside);
    }
}

}  // namespace

void join_background(const EsdfMap& esdf, VoxelMask& voxels, VoxelMask& not_simple) {
  BackgroundJoining joining(esdf, voxels);
  if (joining.has_nothing_to_join()) return;
  for (const Contact& contact : find_contacts(esdf, voxels, not_simple)) {
    detail::stop_if_cancelled();
    joining.join_at(contact);
  }
  update_not_simple(esdf, voxels, joining.removed(), not_simple);
}

}  // namespace ridgeway
