// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "limit_options.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {

using Json = nlohmann::ordered_json;

void add_limit_options(Command& command, LimitOptions& options) {
  command.tuple(
      "--height", options.height, 2, "LOW,HIGH",
      "The robot's centre stays between these heights, metres; no walls, as --bounds are");
  command.box("--keep-in", options.keep_in,
              "The robot's centre stays in the box x0,y0,z0,x1,y1,z1, metres");
  command.boxes("--keep-out", options.keep_out,
                "The robot's centre stays out of the box x0,y0,z0,x1,y1,z1, metres; may be "
                "repeated");
}

FlightLimits limits_of(const LimitOptions& options) {
  FlightLimits limits;
  limits.keep_out = options.keep_out;
  if (options.keep_in) limits.keep_in = *options.keep_in;
  if (!options.height.empty()) {
    const double low = options.height[0], high = options.height[1];
    if (!(low <= high))
      throw InputError("--height '" + number_text(low) + "," + number_text(high) + "'",
                       "has the higher first", "give LOW,HIGH");
    FlightLimits band;
    band.keep_in.min.z() = low;
    band.keep_in.max.z() = high;
    limits = both_of(band, limits);
  }
  if (!(limits.keep_in.min.array() <= limits.keep_in.max.array()).all())
    throw InputError("--height and --keep-in", "have no place in common", "give one of them");
  limits.validate();
  return limits;
}

Json json_of(const FlightLimits& limits) {
  const auto box_json = [](const Box& box) {
    Json numbers = Json::array();
    for (const Point& corner : {box.min, box.max})
      for (const double x : corner) numbers.push_back(std::isfinite(x) ? Json(x) : Json());
    return numbers;
  };
  Json json = {{"keep_in", box_json(limits.keep_in)}, {"keep_out", Json::array()}};
  for (const Box& box : limits.keep_out) json["keep_out"].push_back(box_json(box));
  return json;
}

}  // namespace ridgeway::cli
