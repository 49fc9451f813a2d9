// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "viewpoints.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ridgeway::detail {
namespace {

constexpr double kFarWider = 1.3;  // than the place of a cube: another takes its place

struct Candidate {
  VoxelIndex voxel;
  std::uint32_t squared = 0;
};

/// Side of a cube, voxels.
int side_of(double spacing, double voxel_size) {
  return std::max(2, static_cast<int>(std::lround(spacing / voxel_size)));
}

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

BlockIndex cube_of(const VoxelIndex& voxel, int side) {
  return {floor_div(voxel.x, side), floor_div(voxel.y, side), floor_div(voxel.z, side)};
}

/// Of a place off the diagram: the same for a voxel at any time, and none of a place on it.
std::uint64_t id_of(const VoxelIndex& voxel) {
  constexpr std::uint64_t kOffDiagram = std::uint64_t{1} << 63;
  constexpr std::uint64_t kBits = (std::uint64_t{1} << 21) - 1;  // of maps of up to 2^21 voxels
  const auto bits = [](int at) { return static_cast<std::uint64_t>(at) & kBits; };
  return kOffDiagram | bits(voxel.z) << 42 | bits(voxel.y) << 21 | bits(voxel.x);
}

/// The widest voxel of each cube, of those that are offered.
class Widest {
 public:
  explicit Widest(int side) : side_(side) {}

  void offer(const VoxelIndex& voxel, std::uint32_t squared) {
    const BlockIndex cube = cube_of(voxel, side_);
    if (last_ == of_cube_.end() || last_->first != cube)  // mostly it is that of the one before
      last_ = of_cube_.try_emplace(cube, Candidate{voxel, squared}).first;
    Candidate& now = last_->second;
    if (squared > now.squared || (squared == now.squared && voxel < now.voxel))
      now = {voxel, squared};
  }
  const std::map<BlockIndex, Candidate>& of_cube() const { return of_cube_; }

 private:
  int side_;
  std::map<BlockIndex, Candidate> of_cube_;
  std::map<BlockIndex, Candidate>::iterator last_ = of_cube_.end();
};

}  // namespace

void DiagramPlaces::update(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  if (!(origin_ == esdf.origin)) of_cube_.clear();
  origin_ = esdf.origin;
  const int side = side_of(spacing_, esdf.voxel_size);
  const SquaredHalves threshold = least_clearance(roadmap.min_clearance, esdf.voxel_size);
  Widest best(side);
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot)
    for (std::uint32_t z = 0; z < kBlockSide; ++z)
      for (std::uint64_t bits = roadmap.diagram.voxels.block(slot)[z]; bits != 0;
           bits &= bits - 1) {
        const VoxelId id =
            slot * kBlockVoxels + z * 64 + static_cast<VoxelId>(std::countr_zero(bits));
        if (esdf.is_open(id) && esdf.squared[id] >= threshold)
          best.offer(esdf.layout.index_of(id), esdf.squared[id]);
      }
  std::map<BlockIndex, Place> now;
  for (const auto& [cube, candidate] : best.of_cube()) {
    const auto before = of_cube_.find(cube);
    if (before != of_cube_.end()) {
      const VoxelId id = esdf.layout.find(before->second.voxel);
      if (esdf.is_open(id) && esdf.squared[id] >= threshold &&
          esdf.squared[id] * kFarWider * kFarWider >= candidate.squared) {
        now.emplace(cube, before->second);
        continue;
      }
    }
    now.emplace(cube,
                Place{next_id_++, candidate.voxel, centre_of(candidate.voxel, esdf.voxel_size)});
  }
  of_cube_ = std::move(now);
  places_.clear();
  for (const auto& [cube, place] : of_cube_) places_.push_back(place);
}

std::vector<Place> widest_places(const Roadmap& roadmap, double spacing) {
  const EsdfMap& esdf = roadmap.esdf;
  const int side = side_of(spacing, esdf.voxel_size);
  const SquaredHalves threshold = least_clearance(roadmap.min_clearance, esdf.voxel_size);
  Widest best(side);
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (esdf.is_open(id) && esdf.squared[id] >= threshold)
      best.offer(esdf.layout.index_of(id), esdf.squared[id]);
  std::vector<Place> places;
  places.reserve(best.of_cube().size());
  for (const auto& [cube, candidate] : best.of_cube())
    places.push_back(
        {id_of(candidate.voxel), candidate.voxel, centre_of(candidate.voxel, esdf.voxel_size)});
  return places;
}

}  // namespace ridgeway::detail
