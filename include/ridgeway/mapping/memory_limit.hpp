// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>

namespace ridgeway {

/// What an allocated voxel costs at the peak: in the whole pipeline from map to roadmap, and in a
/// map that is only read to be coarsened or cut down.
inline constexpr int kPipelineBytesPerVoxel = 40;
inline constexpr int kMapBytesPerVoxel = 3;

/// Bytes that this process can still get: the machine's MemAvailable, or what is left to the
/// process's control group if that is less. Where neither can be read: no limit (2^63).
std::uint64_t available_memory_bytes();

/// Throws InputError, naming the bytes needed and available, where there is less than `bytes`.
void require_memory(double bytes, const std::string& name, const std::string& remedy);

/// Refuses a map before it is allocated: throws InputError naming the bytes needed and available
/// and the remedy where `blocks` blocks of 8^3 voxels need more than there is. `name` is the file
/// or the value the map comes from.
void require_memory_for_blocks(double blocks, int bytes_per_voxel, const std::string& name);

}  // namespace ridgeway
