// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridge_header.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "ridge_origin.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// JSON has no infinity: it stands as null.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

double get_number(const Json& header, const char* key, double null_value) {
  const Json& value = header.at(key);
  return value.is_null() ? null_value : value.get<double>();
}

/// An unsigned number below 2^32 - 1; anything else throws what parse_header catches.
std::uint32_t get_count(const Json& counts, const char* key) {
  const Json& value = counts.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= 0xffffffffu) {
    throw std::out_of_range(std::string("'") + key + "' is no count");
  }
  return value.get<std::uint32_t>();
}

UnknownPolicy parse_policy(const std::string& name) {
  if (name == "obstacle") return UnknownPolicy::kObstacle;
  if (name == "ignore") return UnknownPolicy::kIgnore;
  if (name == "free") return UnknownPolicy::kFree;
  throw std::out_of_range("'unknown' is neither obstacle nor ignore nor free");
}

Json json_of_limits(const FlightLimits& limits) {
  const auto box_json = [](const Box& box) {
    Json faces = Json::array();
    for (const Point& corner : {box.min, box.max})
      for (const double x : corner) faces.push_back(number_or_null(x));
    return faces;
  };
  Json json = {{"keep_in", box_json(limits.keep_in)}, {"keep_out", Json::array()}};
  for (const Box& box : limits.keep_out) json["keep_out"].push_back(box_json(box));
  return json;
}

Box box_in(const Json& faces) {
  if (!faces.is_array() || faces.size() != 6) throw std::out_of_range("a limit has not six faces");
  Box box;
  for (int i = 0; i < 6; ++i) {
    const Json& face = faces[static_cast<std::size_t>(i)];
    (i < 3 ? box.min : box.max)[i % 3] =
        face.is_null() ? (i < 3 ? -kInfinity : kInfinity) : face.get<double>();
  }
  return box;
}

FlightLimits limits_in(const Json& json) {
  FlightLimits limits{box_in(json.at("keep_in")), {}};
  for (const Json& box : json.at("keep_out")) limits.keep_out.push_back(box_in(box));
  try {
    limits.validate();
  } catch (const InputError& error) {
    throw std::out_of_range("'limits' are none: " + error.where() + " " + error.problem());
  }
  return limits;
}

/// Bounds every count by others, so that none makes its section large by itself.
void check_counts(const RidgeHeader& header) {
  const double voxels = static_cast<double>(header.blocks) * kBlockVoxels;
  if (header.vertices > voxels) throw std::out_of_range("there are more vertices than voxels");
  if (header.corners > std::min<double>(voxels, TangentGraph::kMostCorners))
    throw std::out_of_range("there are more corners than are learnt");
  if (header.edges > kMostEdgesPerVertex * header.vertices ||
      header.tangent_edges > kMostEdgesPerVertex * header.corners)
    throw std::out_of_range("there are more edges than the vertices can have");
}

RidgeHeader header_from(const Json& json) {
  const Json& counts = json.at("counts");
  RidgeHeader header;
  header.voxel_size = get_number(json, "voxel_size", 0.0);
  header.origin = origin_in(json);
  header.unknown = parse_policy(json.at("unknown").get<std::string>());
  header.max_distance = get_number(json, "max_distance", kInfinity);
  header.planar = json.value("planar", false);
  if (json.contains("limits")) header.limits = limits_in(json.at("limits"));
  header.min_clearance = get_number(json, "min_clearance", kInfinity);
  header.graph_min_clearance = get_number(json, "graph_min_clearance", kInfinity);
  header.complete_diagram = json.at("complete_diagram").get<bool>();
  header.source = json.at("source").get<std::string>();
  header.config = json.at("config").get<std::string>();
  header.blocks = get_count(counts, "blocks");
  header.vertices = get_count(counts, "vertices");
  header.edges = get_count(counts, "edges");
  if (counts.contains("corners")) {  // files without a tangent graph may leave both out
    header.corners = get_count(counts, "corners");
    header.tangent_edges = get_count(counts, "taut_edges");
  }
  if (!(header.voxel_size >= 1e-6 && header.voxel_size <= 1e6))
    throw std::out_of_range("'voxel_size' is no length from 1e-6 to 1e6 metres");
  if (!(header.max_distance >= 0.0) || !(header.min_clearance >= 0.0) ||
      !(header.graph_min_clearance >= 0.0)) {
    throw std::out_of_range("a distance is negative");
  }
  if (header.min_clearance > header.max_distance)
    throw std::out_of_range("'min_clearance' is above 'max_distance'");
  if (header.blocks > 0 && header.min_clearance == 0.0)
    throw std::out_of_range("'min_clearance' is 0, which is no robot's");
  check_counts(header);
  return header;
}

}  // namespace

RidgeHeader header_of(const Roadmap& roadmap) {
  return {roadmap.esdf.voxel_size,
          roadmap.esdf.origin,
          roadmap.esdf.unknown,
          roadmap.esdf.max_distance,
          roadmap.esdf.limits,
          roadmap.esdf.planar,
          roadmap.min_clearance,
          roadmap.graph.min_clearance,
          roadmap.diagram.complete,
          roadmap.source,
          roadmap.config,
          roadmap.esdf.layout.block_count(),
          static_cast<std::uint32_t>(roadmap.graph.vertices.size()),
          static_cast<std::uint32_t>(roadmap.graph.edges.size()),
          static_cast<std::uint32_t>(roadmap.tangents.graph.vertices.size()),
          static_cast<std::uint32_t>(roadmap.tangents.graph.edges.size())};
}

std::string header_text(const RidgeHeader& header) {
  Json json;
  json["content"] = "roadmap";
  json["voxel_size"] = header.voxel_size;
  json["origin"] = json_of_origin(header.origin);
  json["unknown"] = header.unknown == UnknownPolicy::kObstacle ? "obstacle"
                    : header.unknown == UnknownPolicy::kIgnore ? "ignore"
                                                               : "free";
  json["max_distance"] = number_or_null(header.max_distance);
  if (header.planar) json["planar"] = true;
  if (header.limits.any()) json["limits"] = json_of_limits(header.limits);
  json["min_clearance"] = number_or_null(header.min_clearance);
  json["graph_min_clearance"] = number_or_null(header.graph_min_clearance);
  json["complete_diagram"] = header.complete_diagram;
  json["source"] = header.source;
  json["config"] = header.config;
  json["counts"] = {{"blocks", header.blocks},
                    {"vertices", header.vertices},
                    {"edges", header.edges},
                    {"corners", header.corners},
                    {"taut_edges", header.tangent_edges}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

RidgeHeader parse_header(const RidgeReader& reader) {
  try {
    const Json json = Json::parse(reader.header());
    if (const auto content = json.at("content").get<std::string>(); content != "roadmap") {
      throw InputError(reader.path(), "holds a '" + content + "', not a roadmap",
                       "make a roadmap with `ridgeway build`");
    }
    return header_from(json);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    reader.damaged("header", std::string("is not readable: ") + error.what());
  }
}

}  // namespace ridgeway
