// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "lanes.hpp"
#include "voxel/cube_gather.hpp"

namespace ridgeway::detail {

/// Four voxels' steepest moves of one length to a neighbour that rises at least by `least`: a
/// diagonal move to one that rises less might dip.
struct Steepest {
  Floats slope{};  // -1: there is none
  Cubes moves{};   // all that are as steep

  /// `first`: the four levels in a gather.
  template <int squared>
  static Steepest among(const float* first) {
    constexpr float kInverse = squared == 1 ? 1.0f : squared == 2 ? 0.70710678f : 0.57735027f;
    constexpr float kLeast = squared == 1 ? 1.0f : 4.0f * squared;
    const auto beside = [&](int d) { return load_lanes<Floats>(first + bordered_step(d)); };
    Floats highest{};
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d)
      if (squared_length(d) == squared) highest = beside(d) > highest ? beside(d) : highest;
    Steepest steepest;
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d)
      if (squared_length(d) == squared)
        steepest.moves |= reinterpret_cast<Cubes>(beside(d) == highest) & 1u << d;
    const Floats rise = highest - load_lanes<Floats>(first);
    steepest.slope = rise >= kLeast ? rise * kInverse : Floats{} - 1.0f;
    return steepest;
  }
};

/// For four voxels the directions of the steepest ways to higher neighbours, among those without a
/// dip; of equally steep ones the first.
inline Cubes steepest_ways(const float* first, const Cubes& higher) {
  const Steepest all[] = {Steepest::among<1>(first), Steepest::among<2>(first),
                          Steepest::among<3>(first)};
  Floats best{};  // level moves across a face are ways too
  for (const Steepest& s : all) best = s.slope > best ? s.slope : best;
  Cubes moves = reinterpret_cast<Cubes>(best == 0.0f) & higher & kCells6;
  for (const Steepest& s : all) moves |= reinterpret_cast<Cubes>(s.slope == best) & s.moves;
  return moves != 0u ? first_cells(moves) : (moves & 0u) + kCentre;
}

}  // namespace ridgeway::detail
