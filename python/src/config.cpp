// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "config.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::python {
namespace {

constexpr std::array<std::string_view, 3> kPolicies = {"obstacle", "ignore", "free"};
constexpr std::array<std::string_view, 2> kIntegrators = {"projective", "ray_casting"};
constexpr std::array<std::string_view, 2> kStrategies = {"tour", "nearest"};
constexpr std::array<std::string_view, 3> kColours = {"clearance", "height", "component"};

template <std::size_t kCount>
std::size_t choice(py::handle value, const char* name,
                   const std::array<std::string_view, kCount>& choices) {
  const std::string text = text_from(value, name);
  std::string all;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (text == choices[i]) return i;
    all += (i == 0 ? "'" : ", '") + std::string(choices[i]) + "'";
  }
  throw InputError(name, "is '" + text + "'", "give one of " + all);
}

std::string string_literal(std::string_view text) { return "'" + std::string(text) + "'"; }

template <typename Whole>
void read_whole(py::handle value, const char* name, Whole& field) {
  const std::int64_t number = whole_from(value, name);
  if (number < 0 ||
      static_cast<std::uint64_t>(number) > std::uint64_t{std::numeric_limits<Whole>::max()})
    throw InputError(name, "is " + std::to_string(number),
                     "give a whole number, 0 or above, below 2^31");
  field = static_cast<Whole>(number);
}

}  // namespace

void read(py::handle value, const char* name, double& field) {
  field = number_from(value, name);
  if (std::isnan(field)) throw InputError(name, "is not a number", "give a number");
}
void read(py::handle value, const char* name, bool& field) { field = flag_from(value, name); }
void read(py::handle value, const char* name, int& field) { read_whole(value, name, field); }
void read(py::handle value, const char* name, std::size_t& field) {
  read_whole(value, name, field);
}
void read(py::handle value, const char* name, UnknownPolicy& field) {
  field = static_cast<UnknownPolicy>(choice(value, name, kPolicies));
}
void read(py::handle value, const char* name, Planner& field) {
  const std::string text = text_from(value, name);
  const std::optional<Planner> planner = planner_named(text);
  if (!planner || is_sampling(*planner))
    throw InputError(name, "is " + string_literal(text),
                     "give 'graph', 'diagram', 'esdf' or 'theta'");
  field = *planner;
}
void read(py::handle value, const char* name, Smoothness& field) {
  constexpr std::array<std::string_view, 2> names = {"jerk", "snap"};
  field = choice(value, name, names) == 0 ? Smoothness::kJerk : Smoothness::kSnap;
}
void read(py::handle value, const char* name, Integrator& field) {
  field = static_cast<Integrator>(choice(value, name, kIntegrators));
}
void read(py::handle value, const char* name, Point& field) { field = point_from(value, name); }
void read(py::handle value, const char* name, std::filesystem::path& field) {
  field = path_from(value, name);
}
void read(py::handle value, const char* name, FlightLimits& field) {
  if (value.is_none()) {
    field = {};
    return;
  }
  if (!py::isinstance<FlightLimits>(value))
    throw py::type_error(std::string(name) + ": expected FlightLimits, got " + describe(value));
  field = value.cast<const FlightLimits&>();
}
void read(py::handle value, const char* name, Eigen::Isometry3d& field) {
  field = value.is_none() ? Eigen::Isometry3d::Identity() : pose_from(value, name);
}
void read(py::handle value, const char* name, VoxelIndex& field) {
  field = voxel_from(value, name);
}
void read(py::handle value, const char* name, VoxelRange& field) {
  if (value.is_none()) {
    field = kAllVoxels;
    return;
  }
  const auto refuse = [&] {
    throw InputError(name, "is " + describe(value),
                     "give the first and the last voxel of the lattice, (2, 3) whole numbers");
  };
  std::vector<VoxelIndex> ends;
  try {
    ends = voxels_from(value, name);
  } catch (const InputError&) {
    refuse();
  }
  if (ends.size() != 2) refuse();
  field = {ends[0], ends[1]};
}
void read(py::handle value, const char* name, ExplorationStrategy& field) {
  field = static_cast<ExplorationStrategy>(choice(value, name, kStrategies));
}
void read(py::handle value, const char* name, DiagramColour& field) {
  field = static_cast<DiagramColour>(choice(value, name, kColours));
}
void read(py::handle value, const char* name, HeightBand& field) {
  const Doubles ends = doubles_from(value, name, "two heights, metres");
  if (ends.ndim() != 1 || ends.size() != 2)
    throw InputError(name, "is " + describe(value), "give two heights, metres");
  field = {ends.at(0), ends.at(1)};
}
void read(py::handle value, const char* name, std::string& field) {
  field = text_from(value, name);
}
void read(py::handle value, const char* name, UpAxis& field) {
  constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
  field = static_cast<UpAxis>(choice(value, name, names));
}
void read(py::handle value, const char* name, std::vector<Point>& field) {
  field = points_from(value, name);
}
void read(py::handle value, const char* name, Box& field) { field = box_from(value, name); }
void read(py::handle value, const char* name, std::vector<Box>& field) {
  if (!PySequence_Check(value.ptr()))
    throw py::type_error(std::string(name) + ": expected a sequence of boxes, got " +
                         describe(value));
  field.clear();
  std::size_t place = 0;
  for (const py::handle box : value)
    field.push_back(
        box_from(box, (std::string(name) + "[" + std::to_string(place++) + "]").c_str()));
}

std::string literal(double value) {
  if (std::isinf(value)) return value > 0.0 ? "1e999" : "-1e999";  // which reads as infinity
  std::string text = number_text(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}
std::string shown(double value) { return std::isinf(value) ? number_text(value) : literal(value); }
std::string literal(bool value) { return value ? "True" : "False"; }
std::string literal(int value) { return std::to_string(value); }
std::string literal(std::size_t value) { return std::to_string(value); }
std::string literal(UnknownPolicy value) {
  return string_literal(kPolicies[static_cast<std::size_t>(value)]);
}
std::string literal(Planner value) { return string_literal(name_of(value)); }
std::string literal(Smoothness value) { return value == Smoothness::kJerk ? "'jerk'" : "'snap'"; }
std::string literal(Integrator value) {
  return string_literal(kIntegrators[static_cast<std::size_t>(value)]);
}
std::string literal(const VoxelRange&) { return "None"; }
std::string literal(ExplorationStrategy value) {
  return string_literal(kStrategies[static_cast<std::size_t>(value)]);
}
std::string literal(DiagramColour value) {
  return string_literal(kColours[static_cast<std::size_t>(value)]);
}
std::string literal(const std::string& value) { return string_literal(value); }
std::string literal(const Point& p) {
  return "(" + literal(p.x()) + ", " + literal(p.y()) + ", " + literal(p.z()) + ")";
}
std::string literal(const std::filesystem::path& value) { return string_literal(value.string()); }
std::string literal(const FlightLimits&) { return "None"; }
std::string literal(const Eigen::Isometry3d&) { return "None"; }
std::string literal(const std::vector<Box>&) { return "()"; }
std::string literal(const std::vector<Point>&) { return "()"; }

namespace {

/// What others call a parameter, and ours: words that are alike mean something else.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kElsewhere{
    {{"radius", "min_clearance"},
     {"robot_radius", "min_clearance"},
     {"robot_radius", "radius"},
     {"min_clearance", "radius"},
     {"clearance", "radius"},
     {"max_velocity", "max_speed"},
     {"max_vel", "max_speed"},
     {"timeout", "time_limit"},
     {"resolution", "voxel_size"}}};

py::list list_of(const std::vector<std::string>& words) {
  py::list list;
  for (const std::string& word : words) list.append(word);
  return list;
}

/// The parameter that was meant, or empty.
std::string meant_by(const std::string& keyword, const std::vector<std::string>& known) {
  for (const auto& [theirs, ours] : kElsewhere)
    if (keyword == theirs && std::find(known.begin(), known.end(), ours) != known.end())
      return std::string(ours);
  const py::list near =
      py::module_::import("difflib").attr("get_close_matches")(keyword, list_of(known), 1);
  return near.empty() ? "" : std::string(py::str(near[0]));
}

}  // namespace

void refuse_keyword(const std::string& keyword, const std::vector<std::string>& known) {
  const std::string meant = meant_by(keyword, known);
  throw py::type_error(
      "unexpected keyword argument '" + keyword + "'" +
      (meant.empty()
           ? "; there are " + std::string(py::str(py::str(", ").attr("join")(list_of(known))))
           : "; did you mean '" + meant + "'?"));
}

}  // namespace ridgeway::python
