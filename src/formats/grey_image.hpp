// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeway {

/// Brightness row by row from the top, 0 black to 255 white.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;
  std::vector<std::uint8_t> opaque;  ///< 255, or less where one sees through; empty: all is opaque
};

/// Reads a .pgm (P2 or P5, 8 or 16 bits) or a .png file of any kind, whose colours are averaged.
/// Throws InputError naming the file for another format, a damaged file, and where memory would not
/// do; sides are of 65535 pixels at most.
GreyImage read_grey_image(std::string_view bytes, const std::string& name);

}  // namespace ridgeway
