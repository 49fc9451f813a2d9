// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>

#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {

/// What an allocated voxel costs at the peak (kPipelineBytesPerVoxel in the whole pipeline): in the
/// distance field alone, and in a map that is only read to be coarsened or cut down.
inline constexpr int kEsdfBytesPerVoxel = 9;
inline constexpr int kMapBytesPerVoxel = 3;
/// What joining the diagram takes of a voxel of the thinned edges or the kernel, beyond that, and
/// the graph of a voxel of the diagram, bytes: measured on space full of single voxels and on a
/// checkerboard, where they take the most.
inline constexpr int kKernelBytesPerEdgeVoxel = 100;
inline constexpr int kGraphBytesPerDiagramVoxel = 420;

/// What the system says of memory: the contents of its files, empty where there is none.
struct MemoryReadings {
  std::string meminfo = {};       ///< /proc/meminfo
  std::string group_limit = {};   ///< memory.max of the process's control group, bytes or "max"
  std::string group_used = {};    ///< memory.current
  std::string group_stat = {};    ///< memory.stat
  std::string process_used = {};  ///< /proc/self/statm
  std::uint64_t process_limit = 1ull << 63;  ///< of its address space, bytes (ulimit -v)
};
MemoryReadings read_memory();

/// Bytes that this process can still get: the machine's MemAvailable, or what is left to the
/// process's control group or to its address space if that is less. Files that the group has in
/// the page cache are given up when memory is wanted, so they do not count as used. Where none of
/// this can be read: no limit (2^63).
std::uint64_t available_memory_bytes(const MemoryReadings& readings = read_memory());

/// Throws InputError, naming the bytes needed and available, where there is less than `bytes`.
void require_memory(double bytes, const std::string& name, const std::string& remedy);

/// Refuses a map before it is allocated: throws InputError naming the bytes needed and available
/// and the remedy where `blocks` blocks of 8^3 voxels need more than there is. `name` is the file
/// or the value that the map comes from.
void require_memory_for_blocks(double blocks, int bytes_per_voxel, const std::string& name);

}  // namespace ridgeway
