// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ridgeway/sensing/solid_mesh.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// What the program that reads meshes makes of a file: triangles, or what is wrong with it.
struct MeshReply {
  std::string problem;  ///< of printable characters, at most kLongestProblem; empty for none
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;

  static constexpr std::size_t kLongestProblem = 100;
};

/// As bytes, for a pipe: their number, 1, two counts, vertices and triangles; or their number, 0
/// and the problem.
std::vector<std::byte> pack(const MeshReply& reply);

/// The reverse. The program may have been led astray by a damaged file, so that these may be any
/// bytes: nothing where they are not just those that their counts say.
std::optional<MeshReply> unpack(std::span<const std::byte> bytes);

}  // namespace ridgeway
