// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

/// What Python holds: the library's own values, immutable and shared, so that parts of them can be
/// given out, and read by many threads, without a copy.
namespace ridgeway::python {

namespace py = pybind11;

struct MapFace {
  std::shared_ptr<const OccupancyMap> map;
  std::string source;  ///< name of the file that it came from; empty: none
};

struct EsdfFace {
  std::shared_ptr<const EsdfMap> esdf;
};

struct TsdfFace {
  std::shared_ptr<const TsdfMap> tsdf;
};

/// A set of voxels and the map that they are of.
struct MaskFace {
  std::shared_ptr<const EsdfMap> esdf;
  std::shared_ptr<const VoxelMask> mask;
};

struct GraphFace {
  std::shared_ptr<const EsdfMap> esdf;
  std::shared_ptr<const SparseGraph> graph;
};

struct RoadmapFace {
  std::shared_ptr<const Roadmap> roadmap;
  std::optional<BuildReport> report = {};  ///< where it was built here
};

/// A plan and what it was asked for: its trajectory is for the same robot.
struct PlanFace : PlanResult {
  PlanConfig config;
  std::vector<Point> via = {};  ///< places between start and goal that it is to pass, world
  /// Where an end lies in an obstacle, to tell what would help.
  struct Question {
    std::shared_ptr<const Roadmap> roadmap;
    Point start, goal;
  };
  std::shared_ptr<const Question> question = nullptr;
};

/// Some of several routes, and what they were asked for.
struct AlternativesFace : Alternatives {
  PlanConfig config;
};

/// A method that refuses None for its object, which a pointer to it would take.
template <typename Class, typename Result, typename... Arguments>
auto method(Result (Class::*call)(Arguments...)) {
  return [call](Class& self, Arguments... arguments) -> Result {
    return (self.*call)(std::forward<Arguments>(arguments)...);
  };
}
template <typename Class, typename Result, typename... Arguments>
auto method(Result (Class::*call)(Arguments...) const) {
  return [call](const Class& self, Arguments... arguments) -> Result {
    return (self.*call)(std::forward<Arguments>(arguments)...);
  };
}

/// The configuration as a roadmap keeps it, JSON text.
std::string record_of(const BuildConfig& config, double voxel_size);

/// A map of its own for a stage that takes maps by value. Stages that only read and move the states
/// share their memory, the others get a copy.
inline OccupancyMap taken(const OccupancyMap& map, UnknownPolicy unknown) {
  if (unknown == UnknownPolicy::kIgnore) return map;  // small pockets are filled in place
  OccupancyMap shared;
  shared.voxel_size = map.voxel_size;
  shared.origin = map.origin;
  shared.layout = map.layout;
  shared.state = map.state.shared();
  shared.planar = map.planar;
  return shared;
}

// Each adds the classes and functions of one topic.
void add_errors(py::module_& module);
void add_maps(py::module_& module);
void add_fields(py::module_& module);
void add_stages(py::module_& module);
void add_graph(py::module_& module);
void add_plans(py::module_& module);
void add_roadmap(py::module_& module);
void add_flights(py::module_& module);
void add_fusion(py::module_& module);
void add_live(py::module_& module);
void add_exploration(py::module_& module);
/// After all others.
void add_words_for_wrong_calls(py::module_& module);

}  // namespace ridgeway::python
