// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/memory_limit.hpp"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway {
namespace {

std::optional<std::uint64_t> machine_available() {
  std::ifstream file("/proc/meminfo");
  for (std::string key; file >> key;) {
    std::uint64_t kilobytes = 0;
    if (key == "MemAvailable:" && file >> kilobytes) return kilobytes * 1024;
    file.ignore(256, '\n');
  }
  return std::nullopt;
}

std::optional<std::uint64_t> control_group_available() {
  std::uint64_t limit = 0, used = 0;  // the limit reads "max" where there is none
  if (!(std::ifstream("/sys/fs/cgroup/memory.max") >> limit)) return std::nullopt;
  if (!(std::ifstream("/sys/fs/cgroup/memory.current") >> used)) return std::nullopt;
  return limit > used ? limit - used : 0;
}

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text << std::setprecision(3) << bytes / 1e9 << " GB";
  return text.str();
}

}  // namespace

std::uint64_t available_memory_bytes() {
  constexpr std::uint64_t no_limit = 1ull << 63;
  return std::min(machine_available().value_or(no_limit),
                  control_group_available().value_or(no_limit));
}

void require_memory(double bytes, const std::string& name, const std::string& remedy) {
  const double available = static_cast<double>(available_memory_bytes());
  if (bytes <= available) return;
  throw InputError(
      name,
      "needs about " + gigabytes(bytes) + " of memory, " + gigabytes(available) + " are available",
      remedy);
}

void require_memory_for_blocks(double blocks, int bytes_per_voxel, const std::string& name) {
  require_memory(blocks * kBlockVoxels * bytes_per_voxel, name,
                 "use larger voxels, or cut the map down to a smaller box");
}

}  // namespace ridgeway
