// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway {

/// Number of 26-connected parts of the foreground among the 26 neighbours.
constexpr int foreground_parts(Cube27 cube) {
  int parts = 0;
  for (Cube27 left = cube & kCells26; left != 0; ++parts)
    left &= ~flood26(left & (~left + 1), left);
  return parts;
}

/// Number of 6-connected parts of the background in the 18-neighbourhood that touch the centre by
/// a face.
constexpr int background_parts(Cube27 cube) {
  const Cube27 background = ~cube & kCells18;
  int parts = 0;
  for (Cube27 left = background & kCells6; left != 0; ++parts)
    left &= ~flood6(left & (~left + 1), background);
  return parts;
}

/// Whether deleting (or adding) the centre keeps the topology of foreground and background, for
/// 26-connected foreground and 6-connected background (Bertrand and Malandain 1994): exactly one
/// part of each around it.
constexpr bool is_simple(Cube27 cube) {
  const Cube27 foreground = cube & kCells26, background = ~cube & kCells18;
  const Cube27 faces = background & kCells6;
  if (foreground == 0 || faces == 0) return false;
  if (flood26(foreground & (~foreground + 1), foreground) != foreground) return false;
  return (faces & ~flood6(faces & (~faces + 1), background)) == 0;
}

/// Whether the centre is the end of a curve (paper: Thinning): one 26-neighbour; or just one
/// 6-neighbour while all neighbours lie in one octant that contains it (the corner template in all
/// its orientations), for curves that run in 6-steps.
constexpr bool is_curve_end(Cube27 cube) {
  const Cube27 foreground = cube & kCells26;
  if (bit_count(foreground) <= 1) return true;
  if (bit_count(foreground & kCells6) > 1) return false;
  constexpr auto side = [](int axis, int value) { return detail::cells_where(axis, value); };
  if (bit_count(foreground) > 5) return false;  // of an octant: a face's, three edges', a corner's
  for (int octant = 0; octant < 8; ++octant) {
    const Cube27 outside =
        side(0, octant & 1 ? -1 : 1) | side(1, octant & 2 ? -1 : 1) | side(2, octant & 4 ? -1 : 1);
    if ((foreground & outside) == 0 && (foreground & kCells6) != 0) return true;
  }
  return false;
}

}  // namespace ridgeway
