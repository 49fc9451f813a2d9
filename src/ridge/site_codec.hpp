// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {

/// One number for every voxel of a block.
using BlockPlane = std::array<std::int16_t, kBlockVoxels>;

/// Site offsets of a block, an axis a plane. Neighbouring voxels mostly share their site, so the
/// offset of the voxel below (in the lowest layer: of the one before in y or x), moved by the step
/// between them, predicts all but a few; zstd makes little of the zeros that remain.
struct SitePlanes {
  BlockPlane x, y, z;
};

namespace detail {
/// Replaces each value by its difference from the prediction (`decode` false) or the reverse.
/// Voxels without a site (`live` 0, otherwise -1) are 0 in both forms. Arithmetic is modulo 2^16.
template <bool decode>
inline void predict_plane(const BlockPlane& in, const BlockPlane& live, int axis, BlockPlane& out) {
  const BlockPlane& known = decode ? out : in;
  const auto put = [&](std::size_t i, int prediction) {
    const int value = decode ? in[i] + prediction : in[i] - prediction;
    out[i] = static_cast<std::int16_t>(value & live[i]);
  };
  for (std::size_t i = 0; i < 64; ++i) {
    if (i % 8 != 0) {
      put(i, known[i - 1] - (axis == 0));
    } else {
      put(i, i == 0 ? 0 : known[i - 8] - (axis == 1));
    }
  }
  for (std::size_t layer = 64; layer < kBlockVoxels; layer += 64)
    for (std::size_t i = layer; i < layer + 64; ++i) put(i, known[i - 64] - (axis == 2));
}
}  // namespace detail

/// Offsets to differences from their prediction.
inline SitePlanes encode_sites(const SitePlanes& sites, const BlockPlane& live) {
  SitePlanes coded;
  detail::predict_plane<false>(sites.x, live, 0, coded.x);
  detail::predict_plane<false>(sites.y, live, 1, coded.y);
  detail::predict_plane<false>(sites.z, live, 2, coded.z);
  return coded;
}

/// The reverse of encode_sites.
inline void decode_sites(const SitePlanes& coded, const BlockPlane& live, SitePlanes& sites) {
  detail::predict_plane<true>(coded.x, live, 0, sites.x);
  detail::predict_plane<true>(coded.y, live, 1, sites.y);
  detail::predict_plane<true>(coded.z, live, 2, sites.z);
}

}  // namespace ridgeway
