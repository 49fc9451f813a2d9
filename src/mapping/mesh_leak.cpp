// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mesh_leak.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway {
namespace {

using Steps = VoxelField<std::uint16_t>;

/// Directions of the neighbours across faces.
std::vector<int> face_directions() {
  std::vector<int> directions;
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex o = offset_of(d);
    if (o.x * o.x + o.y * o.y + o.z * o.z == 1) directions.push_back(d);
  }
  return directions;
}

/// Of free voxels: steps across faces to the nearest occupied one, at most 65535; 0 elsewhere.
Steps steps_to_walls(const OccupancyMap& map, const std::vector<int>& faces) {
  Steps steps(map.layout);
  std::vector<VoxelId> wave, next;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] == VoxelState::kOccupied) wave.push_back(id);
  for (std::uint16_t count = 1; !wave.empty(); ++count) {
    next.clear();
    for (const VoxelId id : wave)
      for (const int d : faces) {
        const VoxelId n = map.layout.neighbour(id, d);
        if (n == kNoVoxel || map.state[n] != VoxelState::kFree || steps[n] != 0) continue;
        steps[n] = count;
        next.push_back(n);
      }
    wave.swap(next);
    if (count == 0xfffe) break;
  }
  // No wall is reached from there.
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] == VoxelState::kFree && steps[id] == 0) steps[id] = 0xffff;
  return steps;
}

/// Are all voxels free in the box between a voxel and its neighbour?
bool is_open_between(const OccupancyMap& map, VoxelId id, const VoxelIndex& o) {
  for (int part = 1; part < 8; ++part) {
    const VoxelIndex step = {part & 1 ? o.x : 0, part & 2 ? o.y : 0, part & 4 ? o.z : 0};
    const VoxelId n = map.layout.neighbour(id, direction_of(step));
    if (n == kNoVoxel || map.state[n] != VoxelState::kFree) return false;
  }
  return true;
}

/// Away from walls for as long as each step leads farther: a place that somebody names in a corner
/// is not where the way out is narrow.
VoxelId top_above(const OccupancyMap& map, const Steps& steps, VoxelId id) {
  while (true) {
    VoxelId top = id;
    for (int d = 0; d < 27; ++d) {
      const VoxelId n = map.layout.neighbour(id, d);
      if (n != kNoVoxel && steps[n] > steps[top] && is_open_between(map, id, offset_of(d))) top = n;
    }
    if (top == id) return id;
    id = top;
  }
}

}  // namespace

std::optional<MeshLeak> find_leak(const OccupancyMap& map, std::span<const VoxelIndex> from,
                                  const VoxelRange& range) {
  const std::vector<int> faces = face_directions();
  const Steps steps = steps_to_walls(map, faces);
  const VoxelRange within = {range.min + VoxelIndex{1, 1, 1}, range.max - VoxelIndex{1, 1, 1}};
  struct Place {
    VoxelId voxel, narrowest;
  };
  std::vector<std::vector<Place>> open(0x10000);  // by the least steps of the way so far
  VoxelField<std::uint8_t> seen(map.layout);
  const auto add = [&](VoxelId id, std::uint16_t width, VoxelId narrowest) {
    if (id == kNoVoxel || map.state[id] != VoxelState::kFree || seen[id] != 0) return false;
    if (steps[id] < width) {
      width = steps[id];
      narrowest = id;
    }
    open[width].push_back({id, narrowest});
    return true;
  };
  std::uint16_t width = 0;
  for (const VoxelIndex& voxel : from) {
    const VoxelId named = map.layout.find(voxel - map.origin);
    if (named == kNoVoxel) continue;
    const VoxelId id = top_above(map, steps, named);
    add(id, 0xffff, id);
    width = std::max(width, steps[id]);
  }
  // Widths never grow along a way, so the widest place that is open is looked at first.
  while (true) {
    if (open[width].empty()) {
      if (width == 0) return std::nullopt;
      --width;
      continue;
    }
    const Place place = open[width].back();
    open[width].pop_back();
    if (seen[place.voxel] != 0) continue;
    seen[place.voxel] = 1;
    const VoxelIndex voxel = map.origin + map.layout.index_of(place.voxel);
    if (!within.contains(voxel)) {
      const VoxelIndex narrowest = map.origin + map.layout.index_of(place.narrowest);
      return MeshLeak{centre_of(voxel, map.voxel_size), centre_of(narrowest, map.voxel_size),
                      (2.0 * width - 1.0) * map.voxel_size};
    }
    for (const int d : faces) add(map.layout.neighbour(place.voxel, d), width, place.narrowest);
  }
}

}  // namespace ridgeway
