// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "query_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "common/number_text.hpp"
#include "files/read_file.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {
namespace {

/// Whether a line begins with a word that is no number; "nan" and "inf" are meant as numbers.
bool begins_with_name(const std::string& line, std::size_t first) {
  if (std::isalpha(static_cast<unsigned char>(line[first])) == 0) return false;
  std::string word = line.substr(first, 3);
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word != "nan" && word != "inf";
}

Query parse_query(const std::string& line, const std::string& where, double default_radius,
                  double largest_radius) {
  const std::vector<double> v = parse_numbers(line, where);
  const bool finite = std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  if ((v.size() != 6 && v.size() != 7) || !finite)
    throw InputError(where, "is no query", "give x,y,z,x,y,z or x,y,z,x,y,z,radius");
  const double radius = v.size() == 7 ? v[6] : default_radius;
  if (radius <= 0.0) throw InputError(where, "has a radius that is not above 0", "give metres");
  if (radius > largest_radius)
    throw InputError(where,
                     "has a radius of " + number_text(radius) + " m where the map holds distances" +
                         " for " + number_text(largest_radius) + " m",
                     "build the map with a larger --max-distance, or without one");
  return {Point(v[0], v[1], v[2]), Point(v[3], v[4], v[5]), radius};
}

}  // namespace

std::vector<Query> read_queries(const std::filesystem::path& file, double default_radius,
                                double largest_radius) {
  std::istringstream text(read_file(file));
  std::vector<Query> queries;
  std::size_t number = 0;
  bool names_allowed = true;
  for (std::string line; std::getline(text, line);) {
    ++number;
    line.resize(std::min(line.size(), line.find_first_of("#\r")));
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos) continue;
    if (std::exchange(names_allowed, false) && begins_with_name(line, first)) continue;
    queries.push_back(parse_query(line, file.string() + " line " + std::to_string(number),
                                  default_radius, largest_radius));
  }
  if (queries.empty()) throw InputError(file.string(), "has no query", "give x,y,z,x,y,z a line");
  return queries;
}

}  // namespace ridgeway::cli
