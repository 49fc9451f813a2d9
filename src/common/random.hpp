// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace ridgeway {

/// Random numbers that are the same on every machine and library (splitmix64, Steele et al. 2014).
/// Streams that are seeded with different numbers are independent, so parallel loops take one each.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mixed(seed + kStep) ^ mixed(stream * kStep + 1)) {}

  std::uint64_t bits() { return mixed(state_ += kStep); }
  /// In [low, high).
  double uniform(double low = 0.0, double high = 1.0) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  /// In 0 .. count - 1.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }
  /// Of mean 0 and standard deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ull;
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace ridgeway
