// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "benchmark_map.hpp"

#include <optional>
#include <utility>

#include "files/byte_reader.hpp"
#include "files/text.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// Three whole numbers from 0 up and nothing else.
std::optional<VoxelIndex> take_cell(std::string_view line) {
  const auto x = to_number<int>(take_word(line)), y = to_number<int>(take_word(line)),
             z = to_number<int>(take_word(line));
  if (!x || !y || !z || !take_word(line).empty() || *x < 0 || *y < 0 || *z < 0) return std::nullopt;
  return VoxelIndex{*x, *y, *z};
}

}  // namespace

bool is_benchmark_map(std::string_view bytes) { return bytes.starts_with("voxel "); }

OccupancyMap read_benchmark_map(std::string_view bytes, const std::string& name, double voxel_size,
                                const VoxelPlacement& placement) {
  ByteReader reader(bytes, name);
  std::string_view first = reader.take_line();
  const auto size = take_word(first) == "voxel" ? take_cell(first) : std::nullopt;
  if (!size || size->x == 0 || size->y == 0 || size->z == 0)
    throw InputError(name, "line 1 is not \"voxel X Y Z\"", "give the size of the map in cells");
  const VoxelRange all = {{0, 0, 0}, *size - VoxelIndex{1, 1, 1}};
  OccupancyBuilder builder(
      voxel_size,
      {.clip = placement.clip, .bytes_per_voxel = placement.bytes_per_voxel, .name = name});
  builder.fill(placement.motion(all), VoxelState::kFree);
  for (std::size_t line_number = 2; reader.remaining() > 0; ++line_number) {
    std::string_view line = reader.take_line();
    const auto cell = take_cell(line);
    if (cell && all.contains(*cell)) {
      builder.set(placement.motion({*cell, *cell}).min, VoxelState::kOccupied);
    } else if (!take_word(line).empty()) {
      throw InputError(name, "line " + std::to_string(line_number) + " is not a cell of the map",
                       "give three whole numbers within the size in line 1");
    }
  }
  return std::move(builder).finish();
}

}  // namespace ridgeway
