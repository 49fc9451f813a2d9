// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "build_record.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

nlohmann::ordered_json build_record(const BuildConfig& config, double voxel_size) {
  nlohmann::ordered_json record = {
      {"voxel_size", voxel_size},
      {"min_clearance", config.min_clearance},
      {"max_distance", config.max_distance},
      {"unknown", name_of(config.unknown)},
      {"theta", config.theta},
      {"prune_radius", config.prune_radius},
      {"split_deviation", config.split_deviation},
      {"edges", config.basis_point_edges ? "basis-points" : "neighbours"},
      {"significance", config.significance},
      {"diagram", config.paper_diagram ? "paper" : "full"},
      {"graph", config.simplify ? "simple" : "fitted"}};
  if (config.least_apart > 0.0) record["least_apart"] = config.least_apart;
  if (config.limits.any()) record["limits"] = limits_record(config.limits);
  return record;
}

GvdConfig gvd_of_record(const std::string& record) {
  GvdConfig config;
  const auto json = nlohmann::ordered_json::parse(record, nullptr, false);
  if (!json.is_object()) return config;
  const auto take = [&](const char* name, double& value) {
    if (json.contains(name) && json[name].is_number()) value = json[name].get<double>();
  };
  take("theta", config.theta);
  take("least_apart", config.least_apart);
  return config;
}

nlohmann::ordered_json limits_record(const FlightLimits& limits) {
  using Json = nlohmann::ordered_json;
  const auto numbers_of = [](const Box& box) {
    Json numbers = Json::array();
    for (const Point& corner : {box.min, box.max})
      for (const double x : corner) numbers.push_back(std::isfinite(x) ? Json(x) : Json());
    return numbers;
  };
  Json json = {{"keep_in", numbers_of(limits.keep_in)}, {"keep_out", Json::array()}};
  for (const Box& box : limits.keep_out) json["keep_out"].push_back(numbers_of(box));
  return json;
}

}  // namespace ridgeway
