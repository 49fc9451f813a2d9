// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace ridgeway::detail {

/// One value for every slot, zero at first, in pages of 64. Copies share pages until one of them is
/// written to, and pages that nobody has written to are all one and the same: what a copy costs is
/// a pointer and a byte a page, what an empty array costs, too.
template <typename Value>
class SharedPages {
 public:
  static constexpr std::uint32_t kPerPage = 64;

  SharedPages() = default;
  SharedPages(const SharedPages& other)
      : pages_(other.pages_), states_(other.states_.size(), kShared), count_(other.count_) {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      if (!is_there(i)) continue;
      pages_[i]->owners.fetch_add(1, std::memory_order_relaxed);
      std::atomic_ref(other.states_[i]).store(kShared, std::memory_order_relaxed);
    }
  }
  SharedPages(SharedPages&& other) noexcept
      : pages_(std::exchange(other.pages_, {})),
        states_(std::exchange(other.states_, {})),
        count_(std::exchange(other.count_, 0)) {}
  SharedPages& operator=(SharedPages other) noexcept {
    pages_.swap(other.pages_);
    states_.swap(other.states_);
    std::swap(count_, other.count_);
    return *this;
  }
  ~SharedPages() {
    for (Page* page : pages_) release(page);
  }

  /// So many slots from now on, no fewer than before.
  void grow(std::uint32_t count) {
    const std::size_t pages = (std::size_t{count} + kPerPage - 1) / kPerPage;
    if (pages > pages_.capacity()) pages_.reserve(std::max(pages, 2 * pages_.size()));
    states_.resize(pages, kShared);
    pages_.resize(pages, nobodys());
    count_ = count;
  }
  /// All zero again, at the same size.
  void clear() noexcept {
    for (std::size_t i = 0; i < pages_.size(); ++i) release(std::exchange(pages_[i], nobodys()));
    std::fill(states_.begin(), states_.end(), std::uint8_t{kShared});
  }
  std::uint32_t size() const { return count_; }
  std::size_t page_count() const { return pages_.size(); }
  /// Whether anybody has written to a page; else its values are zero.
  bool is_there(std::size_t page) const { return pages_[page] != nobodys(); }
  std::size_t memory_bytes() const {
    std::size_t bytes = pages_.capacity() * sizeof(void*) + states_.capacity();
    for (std::size_t page = 0; page < pages_.size(); ++page)
      if (is_there(page)) bytes += sizeof(Page);
    return bytes;
  }

  const Value& operator[](std::uint32_t slot) const {
    return pages_[slot / kPerPage]->values[slot % kPerPage];
  }
  /// To be written to; for any thread, while none reads others of the same page.
  Value& own(std::uint32_t slot) {
    const std::uint32_t page = slot / kPerPage;
    if (std::atomic_ref(states_[page]).load(std::memory_order_acquire) != kOwn) own_page(page);
    return pages_[page]->values[slot % kPerPage];
  }

 private:
  struct Page {
    std::array<Value, kPerPage> values{};
    std::atomic<std::uint32_t> owners = 1;
  };
  enum State : std::uint8_t { kShared, kOwn, kBusy };  // busy: a thread makes it its own

  /// Stands for a page that is not there, so that none has to be asked before it is read. Never
  /// written to.
  static Page nobodys_page;
  static Page* nobodys() { return &nobodys_page; }

  static void release(Page* page) {
    if (page != nobodys() && page->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete page;
  }

  void own_page(std::uint32_t index) {
    const std::atomic_ref state(states_[index]);
    for (std::uint8_t expected = kShared; !state.compare_exchange_strong(expected, kBusy);
         expected = kShared)
      if (expected == kOwn) return;
    try {
      Page* const before = pages_[index];
      if (before == nobodys() || before->owners.load(std::memory_order_acquire) > 1) {
        auto* const own = new Page;
        own->values = before->values;
        pages_[index] = own;
        release(before);
      }
    } catch (...) {
      state.store(kShared);
      throw;
    }
    state.store(kOwn, std::memory_order_release);
  }

  std::vector<Page*> pages_;
  mutable std::vector<std::uint8_t> states_;  // by page: a copy makes those of both shared
  std::uint32_t count_ = 0;
};

template <typename Value>
constinit typename SharedPages<Value>::Page SharedPages<Value>::nobodys_page;

}  // namespace ridgeway::detail
