// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "lanes.hpp"
#include "voxel/cube_gather.hpp"

namespace ridgeway::detail {

/// Some voxels' steepest moves of one length to a neighbour that rises at least by `least`: a
/// diagonal move to one that rises less might dip.
template <int lanes>
struct Steepest {
  using Cubes = typename Row<lanes>::Cubes;
  using Floats = typename Row<lanes>::Floats;
  Floats slope{};  // -1: there is none
  Cubes moves{};   // all that are as steep

  /// `first`: their levels in a gather.
  template <int squared>
  [[gnu::always_inline]] void look(const float* first) {
    constexpr float kInverse = squared == 1 ? 1.0f : squared == 2 ? 0.70710678f : 0.57735027f;
    constexpr float kLeast = squared == 1 ? 1.0f : 4.0f * squared;
    Floats highest{};
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d)
      if (squared_length(d) == squared) {
        const Floats beside = load_lanes<Floats>(first + bordered_step(d));
        highest = beside > highest ? beside : highest;
      }
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d)
      if (squared_length(d) == squared) {
        const Floats beside = load_lanes<Floats>(first + bordered_step(d));
        moves |= reinterpret_cast<Cubes>(beside == highest) & 1u << d;
      }
    const Floats rise = highest - load_lanes<Floats>(first);
    slope = rise >= kLeast ? rise * kInverse : Floats{} - 1.0f;
  }
};

/// For some voxels the directions of the steepest ways to higher neighbours, among those without a
/// dip; of equally steep ones the first.
template <int lanes>
[[gnu::always_inline]] inline typename Row<lanes>::Cubes steepest_ways(
    const float* first, const typename Row<lanes>::Cubes& higher) {
  using Cubes = typename Row<lanes>::Cubes;
  Steepest<lanes> all[3];
  all[0].template look<1>(first);
  all[1].template look<2>(first);
  all[2].template look<3>(first);
  typename Row<lanes>::Floats best{};  // level moves across a face are ways too
  for (const auto& s : all) best = s.slope > best ? s.slope : best;
  Cubes moves = reinterpret_cast<Cubes>(best == 0.0f) & higher & kCells6;
  for (const auto& s : all) moves |= reinterpret_cast<Cubes>(s.slope == best) & s.moves;
  return moves != 0u ? first_cells<lanes>(moves) : (moves & 0u) + kCentre;
}

}  // namespace ridgeway::detail
