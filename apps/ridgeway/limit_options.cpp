// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "limit_options.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/number_text.hpp"
#include "formats/build_record.hpp"
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

Json json_of(const FlightLimits& limits) { return limits_record(limits); }

}  // namespace ridgeway::cli
