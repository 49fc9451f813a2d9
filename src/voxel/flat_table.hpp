// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgeway::detail {

/// Mixes all bits of a number into all others.
inline std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 32) * 0x9e3779b97f4a7c15ull;
  return bits ^ bits >> 29;
}

/// Values by key, one after the other in memory that is kept when they are cleared, and a table of
/// where each is: open addressing, at most three quarters full. Who asks gives the hash of the key,
/// the lower half of which should be mixed; values stay where they are until the next one is added
/// or erased.
template <typename Key, typename Value>
class FlatTable {
 public:
  std::size_t size() const { return entries_.size(); }

  /// Null where there is none.
  const Value* find(const Key& key, std::uint64_t hash) const {
    if (places_.empty()) return nullptr;
    const Place& place = places_[place_of(key, tag_of(hash))];
    return place.tag == kFree ? nullptr : &entries_[place.entry].value;
  }

  /// Of a key that has a value.
  const Value& at(const Key& key, std::uint64_t hash) const {
    return entries_[places_[place_of(key, tag_of(hash))].entry].value;
  }

  /// Of a key that has no value yet.
  void add(const Key& key, std::uint64_t hash, const Value& value) {
    if (4 * (size() + 1) > 3 * places_.size()) spread(std::max(kLeastPlaces, 2 * places_.size()));
    entries_.push_back({key, value, tag_of(hash)});
    put(static_cast<std::uint32_t>(size() - 1));
  }

  /// Of a key that has a value.
  void erase(const Key& key, std::uint64_t hash) {
    const std::size_t place = place_of(key, tag_of(hash));
    const std::uint32_t entry = places_[place].entry;
    const Entry& last = entries_.back();
    places_[place_of(last.key, last.tag)].entry = entry;
    entries_[entry] = last;
    entries_.pop_back();
    free(place);
  }

  /// Makes room for so many values.
  void reserve(std::size_t values) {
    std::size_t places = std::max(kLeastPlaces, places_.size());
    while (3 * places < 4 * values) places *= 2;
    if (places > places_.size()) spread(places);
    entries_.reserve(values);
  }

  void clear() {
    if (kRoomy * size() < places_.size()) *this = {};  // far more than it needed
    std::fill(places_.begin(), places_.end(), Place());
    entries_.clear();
  }

 private:
  static constexpr std::uint32_t kFree = 0;
  static constexpr std::size_t kLeastPlaces = 64, kRoomy = 16;
  struct Entry {
    Key key;
    Value value;
    std::uint32_t tag;
  };
  struct Place {
    std::uint32_t tag = kFree, entry = 0;
  };

  static std::uint32_t tag_of(std::uint64_t hash) { return static_cast<std::uint32_t>(hash) | 1; }
  std::size_t first_place(std::uint32_t tag) const { return tag >> 1 & (places_.size() - 1); }
  std::size_t next_place(std::size_t place) const { return (place + 1) & (places_.size() - 1); }

  /// Of a key, or the free place where it would be.
  std::size_t place_of(const Key& key, std::uint32_t tag) const {
    std::size_t place = first_place(tag);
    while (places_[place].tag != kFree &&
           (places_[place].tag != tag || entries_[places_[place].entry].key != key))
      place = next_place(place);
    return place;
  }

  void put(std::uint32_t entry) {
    const std::uint32_t tag = entries_[entry].tag;
    std::size_t place = first_place(tag);
    while (places_[place].tag != kFree) place = next_place(place);
    places_[place] = {tag, entry};
  }

  /// What lies behind a place and would no longer be found moves up.
  void free(std::size_t hole) {
    const std::size_t last = places_.size() - 1;
    for (std::size_t place = next_place(hole); places_[place].tag != kFree;
         place = next_place(place)) {
      const std::size_t first = first_place(places_[place].tag);
      if (((place - first) & last) < ((place - hole) & last)) continue;
      places_[hole] = places_[place];
      hole = place;
    }
    places_[hole] = {};
  }

  void spread(std::size_t places) {
    places_ = std::vector<Place>(places);
    for (std::uint32_t entry = 0; entry < size(); ++entry) put(entry);
  }

  std::vector<Place> places_;
  std::vector<Entry> entries_;
};

}  // namespace ridgeway::detail
