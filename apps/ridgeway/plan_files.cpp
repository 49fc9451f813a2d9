// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "plan_files.hpp"

#include <string>

#include "files/text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"

namespace ridgeway::cli {
namespace {

bool is_mission(const std::filesystem::path& file) { return extension_of(file) == ".plan"; }

Datum datum_of(const PlanOptions& options) {
  const Point& place = *options.datum;
  Datum datum{place.x(), place.y(), place.z()};
  datum.x_heading = options.x_heading.value_or(datum.x_heading);
  return datum;
}

}  // namespace

std::filesystem::path output_of_route(const PlanOptions& options, std::size_t number) {
  std::filesystem::path file(options.output);
  return file.replace_filename(file.stem().string() + "-" + std::to_string(number) +
                               file.extension().string());
}

void require_outputs(const PlanOptions& options) {
  if (!is_mission(options.output)) {
    if (options.datum || options.x_heading)
      throw InputError(options.datum ? "--datum" : "--x-heading", "places missions on the Earth",
                       "write one with -o mission.plan, or leave it out");
    if (!options.output.empty())
      require_extension(options.output, "a path", {".csv", ".json", ".plan"});
    return;
  }
  if (!options.datum)
    throw InputError(options.output, "is a mission, which is in degrees",
                     "say where the map lies with --datum LATITUDE,LONGITUDE,ALTITUDE");
  try {
    datum_of(options).validate();
  } catch (const InputError& error) {
    throw error.within("--datum");
  }
}

void write_output(const PlanOptions& options, const PlanResult& plan,
                  const std::filesystem::path& file) {
  if (is_mission(file))
    write_mission(plan, datum_of(options), file);
  else
    write_plan(plan, file);
}

}  // namespace ridgeway::cli
