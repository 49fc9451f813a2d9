// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): theirs
class App;
}

namespace ridgeway::cli {

/// Each reads the text of an option and throws InputError, naming the option and the text, where
/// it does not hold what it should.

/// Numbers between commas or blanks; infinite ones are numbers, NaN is none.
std::vector<double> parse_numbers(std::string_view text, const std::string& option);
/// "x,y,z", metres.
Point parse_point(std::string_view text, const std::string& option);
/// "x0,y0,z0,x1,y1,z1", two opposite corners, metres, the lesser first.
Box parse_box(std::string_view text, const std::string& option);
/// "x,y,z,roll,pitch,yaw" in metres and degrees (yaw is applied last), the 16 numbers of a matrix
/// row by row, or a name: "camera" takes x right, y down, z forward to x forward, y left, z up;
/// "y-up" takes y up to z up and leaves x.
Eigen::Isometry3d parse_transform(std::string_view text, const std::string& option);

/// Throws InputError where a file could not be written, is named twice, or is one of those that are
/// read: to be known before the long work.
void require_writable(const std::vector<std::filesystem::path>& files,
                      const std::vector<std::filesystem::path>& inputs);

/// Adds --seed; what is no number from 0 to 1.8e19 is refused.
void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& help);

/// A list of numbers that begins with a minus sign looks like an option to a parser of command
/// lines: "--from -1,2,0.5" becomes "--from=-1,2,0.5".
std::vector<std::string> join_negative_values(int argc, const char* const* argv);

}  // namespace ridgeway::cli
