// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "temporary.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "remove_tree.hpp"

namespace ridgeway {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = ".ridgeway-";
constexpr std::string_view kEnd = ".tmp";
constexpr int kSlots =
    64;  // of temporaries at a time; those beyond are removed by ~Temporary alone

std::array<std::atomic<char*>, kSlots> names{};

int keep_name(const fs::path& path) {
  char* name = ::strdup(path.c_str());
  for (int slot = 0; name != nullptr && slot < kSlots; ++slot) {
    char* none = nullptr;
    if (names[static_cast<std::size_t>(slot)].compare_exchange_strong(none, name)) return slot;
  }
  std::free(name);
  return -1;
}

void forget_name(int slot) {
  if (slot >= 0) std::free(names[static_cast<std::size_t>(slot)].exchange(nullptr));
}

/// ".office.ridge.ridgeway-PID-COUNT.tmp": no other process of the machine has it.
fs::path name_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  std::string name(1, '.');
  name.append(target.filename().string()).append(kMark).append(std::to_string(::getpid()));
  name.append("-").append(std::to_string(counter++)).append(kEnd);
  return target.parent_path() / name;
}

bool is_temporary_name(std::string_view name) {
  const std::size_t mark = name.rfind(kMark);
  if (!name.starts_with('.') || !name.ends_with(kEnd) || mark == std::string_view::npos)
    return false;
  name.remove_suffix(kEnd.size());
  name.remove_prefix(std::min(mark + kMark.size(), name.size()));
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isdigit(c) != 0 || c == '-';
  });
}

bool is_same_file(int descriptor, const fs::path& path) {
  struct stat open = {}, named = {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// Removes a temporary that nobody holds a lock on; whoever makes one locks it, and looks then
/// whether it is still there.
void remove_if_stale(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_same_file(descriptor, path))
    detail::remove_tree(path.c_str());
  ::close(descriptor);
}

/// What killed processes have left in a folder; it is looked through once.
void remove_stale(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> seen;
  const std::lock_guard<std::mutex> lock(mutex);
  if (!seen.insert(folder).second) return;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_temporary_name(entry->path().filename().string())) remove_if_stale(entry->path());
}

}  // namespace

Temporary::Temporary(const fs::path& target, Kind kind) {
  remove_stale(target.parent_path());
  do {
    forget_name(slot_);
    path_ = name_beside(target);
    slot_ = keep_name(path_);
  } while (!make(kind));
  if (error_ != 0) path_.clear();
}

/// False where another name has to be tried.
bool Temporary::make(Kind kind) {
  error_ = 0;
  if (kind == Kind::kFolder) {
    if (::mkdir(path_.c_str(), 0777) != 0) {
      error_ = errno;
      return error_ != EEXIST;
    }
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0 && errno == ENOENT) return false;  // taken for a stale one
  } else {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && (errno == EEXIST || errno == EINTR)) return false;
  }
  if (descriptor_ < 0) {
    error_ = errno;
    if (kind == Kind::kFolder) ::rmdir(path_.c_str());
    return true;
  }
  // File systems without locks leave stale files where they are.
  const bool is_taken = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!is_taken && is_same_file(descriptor_, path_)) return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

Temporary::~Temporary() {
  if (!path_.empty()) detail::remove_tree(path_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
  forget_name(slot_);
}

int Temporary::move_to(const fs::path& target) {
  const int lock = ::dup(descriptor_);  // keeps it locked until it has its name
  int error = ::close(descriptor_) != 0 ? errno : 0;
  descriptor_ = -1;
  if (error == 0 && std::rename(path_.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) path_.clear();
  if (lock >= 0) ::close(lock);
  return error;
}

void remove_temporaries() noexcept {
  for (const std::atomic<char*>& name : names)
    if (const char* path = name.load(); path != nullptr) detail::remove_tree(path);
}

}  // namespace ridgeway
