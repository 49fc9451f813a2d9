// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::cli {

/// What a number may be. NaN is none, and those so small that they lose digits are refused.
struct Range {
  double least = 0.0, most = 0.0;
  bool above = false;    ///< `least` itself is out
  bool endless = false;  ///< "inf" may be given, for no limit
};

/// Metres: from micrometres to the size of a country.
inline constexpr Range kLengths = {1e-6, 1e6};
inline constexpr Range kLengthsFromZero = {0.0, 1e6};
inline constexpr Range kReaches = {.least = 1e-6, .most = 1e6, .endless = true};
/// Seconds of patience.
inline constexpr Range kTimeLimits = {.least = 0.0, .most = 1e9, .above = true, .endless = true};
/// Metres a second, a second^2, a second^3.
inline constexpr Range kMotions = {1e-6, 1e6};
inline constexpr Range kDegrees = {-1e6, 1e6};

/// What a whole number may be.
struct Wholes {
  std::uint64_t least = 0, most = 0;
};

/// A motion and how it was written.
struct Transform {
  std::string text;
  Eigen::Isometry3d value = Eigen::Isometry3d::Identity();
};

/// Text as it may stand in a message: between quotes, cut where it is long. The message itself is
/// made printable where it is printed.
std::string in_quotes(std::string_view text);

// Each reads the text of an option and throws InputError, naming the option and the text, where it
// does not hold what it should.

double parse_number(std::string_view text, const Range& range, const std::string& option);
std::uint64_t parse_whole(std::string_view text, const Wholes& range, const std::string& option);
/// Numbers between commas or blanks; infinite ones are numbers, NaN is none.
std::vector<double> parse_numbers(std::string_view text, const std::string& option);
/// "x,y,z", finite.
Point parse_point(std::string_view text, const std::string& option,
                  const std::string& shown = "X,Y,Z");
/// "x0,y0,z0,x1,y1,z1", two opposite corners, metres, the lesser first.
Box parse_box(std::string_view text, const std::string& option);
/// "x,y,z,roll,pitch,yaw" in metres and degrees (yaw is applied last), the 16 numbers of a matrix
/// row by row, or a name: "camera" takes x right, y down, z forward to x forward, y left, z up;
/// "y-up" takes y up to z up and leaves x.
Eigen::Isometry3d parse_transform(std::string_view text, const std::string& option);

/// A box as parse_box takes it.
std::string box_text(const Box& box);

/// "-1 to 5", for messages and descriptions.
std::string range_text(const Range& range);

/// Throws InputError where a file could not be written, is named twice, or is one of those that are
/// read: to be known before the long work.
void require_writable(const std::vector<std::filesystem::path>& files,
                      const std::vector<std::filesystem::path>& inputs);

/// Throws InputError where one of the files is a folder that is written too, or lies in it.
void require_outside(const std::filesystem::path& folder,
                     const std::vector<std::filesystem::path>& files);

/// Throws InputError unless the name of what is written ends as it should: a map must not be
/// written over because the wrong name slipped in. `what` as in "a roadmap".
void require_extension(const std::filesystem::path& file, const std::string& what,
                       std::initializer_list<const char*> extensions);

/// A value that begins with a minus sign looks like an option to a parser of command lines:
/// "--from -1,2,0.5" becomes "--from=-1,2,0.5". Throws InputError for "--radius=", which the
/// parser would take the next word for.
std::vector<std::string> join_values(int argc, const char* const* argv);

}  // namespace ridgeway::cli
