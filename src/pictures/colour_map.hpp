// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace ridgeway {

struct Colour {
  double r = 0.0, g = 0.0, b = 0.0;  ///< 0 to 1
};

/// Of series and paths that are drawn together: told apart by colour-blind readers too.
inline constexpr std::array<Colour, 8> kSeriesColours = {{{0.16, 0.36, 0.58},
                                                          {0.84, 0.37, 0.00},
                                                          {0.00, 0.55, 0.45},
                                                          {0.65, 0.30, 0.60},
                                                          {0.90, 0.62, 0.00},
                                                          {0.34, 0.70, 0.91},
                                                          {0.45, 0.32, 0.20},
                                                          {0.25, 0.25, 0.28}}};

/// Violet, blue, teal, green, amber for shares 0 to 1 (values that are no number count as 1): even
/// in lightness steps, told apart by colour-blind readers, none of it as red as a path.
inline Colour ramp_colour(double share) {
  constexpr std::array<Colour, 5> stops = {{{0.30, 0.16, 0.48},
                                            {0.21, 0.37, 0.60},
                                            {0.13, 0.55, 0.55},
                                            {0.41, 0.74, 0.36},
                                            {0.93, 0.78, 0.22}}};
  const double at = (share >= 0.0 && share < 1.0 ? share : share < 0.0 ? 0.0 : 1.0) * 4.0;
  const auto low = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
  const double t = at - static_cast<double>(low);
  const Colour &a = stops[low], &b = stops[low + 1];
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// Of connected components, largest first: neighbouring numbers get hues far apart (steps of the
/// golden angle); they repeat after kComponentColours.
inline constexpr std::size_t kComponentColours = 24;
inline Colour component_colour(std::size_t component) {
  const double number = static_cast<double>(component % kComponentColours);
  const double hue = std::fmod(number * 137.508 + 210.0, 360.0);
  const double lightness = component / 3 % 2 == 0 ? 0.45 : 0.36;
  const auto channel = [&](double n) {
    const double k = std::fmod(n + hue / 30.0, 12.0);
    return lightness - 0.8 * lightness * std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
  };
  return {channel(0.0), channel(8.0), channel(4.0)};
}

inline std::array<std::uint8_t, 3> bytes_of(const Colour& c) {
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(v * 255.0)); };
  return {byte(c.r), byte(c.g), byte(c.b)};
}

}  // namespace ridgeway
