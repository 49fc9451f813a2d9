// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string_view>

#include "ridgeway/common/error.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway {
namespace {

constexpr std::uint64_t kNoLimit = 1ull << 63;

/// The number behind a word of a text that lists one to a line.
std::optional<std::uint64_t> value_of(std::string_view wanted, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    std::uint64_t value = 0;
    if (words >> word && word == wanted && words >> value) return value;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> first_number(const std::string& text) {
  std::uint64_t value = 0;
  if (!(std::istringstream(text) >> value)) return std::nullopt;
  return value;
}

std::uint64_t machine_available(const MemoryReadings& readings) {
  const std::optional<std::uint64_t> kilobytes = value_of("MemAvailable:", readings.meminfo);
  return kilobytes ? *kilobytes * 1024 : kNoLimit;
}

std::uint64_t group_available(const MemoryReadings& readings) {
  const std::optional<std::uint64_t> limit = first_number(readings.group_limit);
  const std::optional<std::uint64_t> used = first_number(readings.group_used);
  if (!limit || !used) return kNoLimit;  // the limit reads "max" where there is none
  std::uint64_t cached = 0;
  for (const char* kind : {"inactive_file", "active_file", "slab_reclaimable"})
    cached += value_of(kind, readings.group_stat).value_or(0);
  const std::uint64_t held = *used - std::min(*used, cached);
  return *limit - std::min(*limit, held);
}

std::uint64_t address_space_available(const MemoryReadings& readings) {
  const std::optional<std::uint64_t> pages = first_number(readings.process_used);
  if (!pages) return kNoLimit;
  const std::uint64_t used = *pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return readings.process_limit - std::min(readings.process_limit, used);
}

std::string content_of(const char* file) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text << std::setprecision(3) << bytes / 1e9 << " GB";
  return text.str();
}

}  // namespace

MemoryReadings read_memory() {
  MemoryReadings readings = {.meminfo = content_of("/proc/meminfo"),
                             .group_limit = content_of("/sys/fs/cgroup/memory.max"),
                             .group_used = content_of("/sys/fs/cgroup/memory.current"),
                             .group_stat = content_of("/sys/fs/cgroup/memory.stat"),
                             .process_used = content_of("/proc/self/statm")};
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    readings.process_limit = limit.rlim_cur;
  return readings;
}

std::uint64_t available_memory_bytes(const MemoryReadings& readings) {
  return std::min({machine_available(readings), group_available(readings),
                   address_space_available(readings), kNoLimit});
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
