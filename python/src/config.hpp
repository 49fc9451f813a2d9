// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "convert.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/pictures/picture.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

/// The fields of the library's config structs as keyword arguments: one table a struct says which
/// there are, and makes of them values, signatures and docstrings, so that none can differ.
namespace ridgeway::python {

// Values of fields. `name` as in convert.hpp.
void read(py::handle value, const char* name, double& field);
void read(py::handle value, const char* name, bool& field);
void read(py::handle value, const char* name, int& field);
void read(py::handle value, const char* name, std::size_t& field);
void read(py::handle value, const char* name, UnknownPolicy& field);
void read(py::handle value, const char* name, Planner& field);
void read(py::handle value, const char* name, Smoothness& field);
void read(py::handle value, const char* name, Integrator& field);
void read(py::handle value, const char* name, Point& field);
void read(py::handle value, const char* name, std::filesystem::path& field);
void read(py::handle value, const char* name, FlightLimits& field);
void read(py::handle value, const char* name, Eigen::Isometry3d& field);
void read(py::handle value, const char* name, VoxelIndex& field);
void read(py::handle value, const char* name, VoxelRange& field);
void read(py::handle value, const char* name, ExplorationStrategy& field);
void read(py::handle value, const char* name, DiagramColour& field);
void read(py::handle value, const char* name, HeightBand& field);
void read(py::handle value, const char* name, std::string& field);
void read(py::handle value, const char* name, UpAxis& field);
void read(py::handle value, const char* name, std::vector<Point>& field);
void read(py::handle value, const char* name, Box& field);
void read(py::handle value, const char* name, std::vector<Box>& field);
template <typename Value>
void read(py::handle value, const char* name, std::optional<Value>& field) {
  if (value.is_none()) {
    field.reset();
  } else {
    Value inner{};
    read(value, name, inner);
    field = std::move(inner);
  }
}

// Defaults as a signature has them.
std::string literal(double value);
/// As people read it: inf where `literal` has what Python reads as that.
std::string shown(double value);
std::string literal(bool value);
std::string literal(int value);
std::string literal(std::size_t value);
std::string literal(UnknownPolicy value);
std::string literal(Planner value);
std::string literal(Smoothness value);
std::string literal(Integrator value);
std::string literal(const VoxelRange& value);
std::string literal(ExplorationStrategy value);
std::string literal(DiagramColour value);
std::string literal(const std::string& value);
std::string literal(const Point& p);
std::string literal(const std::filesystem::path& value);
template <typename Value>
std::string literal(const std::optional<Value>&) {
  return "None";
}
std::string literal(const FlightLimits&);
std::string literal(const Eigen::Isometry3d&);
std::string literal(const std::vector<Box>&);
std::string literal(const std::vector<Point>&);

/// Throws TypeError for a keyword argument that is not one of `known`, with the one that was meant.
[[noreturn]] void refuse_keyword(const std::string& keyword, const std::vector<std::string>& known);

template <typename Config>
class Fields {
 public:
  template <typename Part, typename Value>
  Fields& add(Part Config::*part, const char* name, Value Part::*member, const char* doc) {
    fields_.push_back({name, doc, literal(Config{}.*part.*member),
                       [part, member, name](Config& config, py::handle value) {
                         read(value, name, config.*part.*member);
                       }});
    return *this;
  }
  template <typename Value>
  Fields& add(const char* name, Value Config::*member, const char* doc) {
    fields_.push_back(
        {name, doc, literal(Config{}.*member),
         [member, name](Config& config, py::handle value) { read(value, name, config.*member); }});
    return *this;
  }

  /// The configuration that keyword arguments ask for, validated. `others`: the names of those that
  /// the function takes too.
  Config read_all(const py::kwargs& keywords, const std::vector<std::string>& others = {}) const {
    Config config;
    if (keywords.empty()) return config;
    for (const auto& [key, value] : keywords) set(config, key, value, others);
    config.validate();
    return config;
  }
  /// Takes those keyword arguments that are of this struct out of the others.
  Config take(py::kwargs& keywords) const {
    Config config;
    for (const Field& field : fields_) {
      if (!keywords.contains(field.name)) continue;
      field.set(config, keywords[field.name]);
      PyDict_DelItemString(keywords.ptr(), field.name);
    }
    return config;
  }

  /// ", radius=None, shorten=True".
  std::string signature() const {
    std::string text;
    for (const Field& field : fields_) text += std::string(", ") + field.name + "=" + field.initial;
    return text;
  }
  /// A line for each field.
  std::string docs() const {
    std::string text;
    for (const Field& field : fields_) text += std::string("\n  ") + field.name + ": " + field.doc;
    return text;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Field& field : fields_) names.emplace_back(field.name);
    return names;
  }

 private:
  struct Field {
    const char* name;
    const char* doc;
    std::string initial;
    std::function<void(Config&, py::handle)> set;
  };

  void set(Config& config, py::handle key, py::handle value,
           const std::vector<std::string>& others) const {
    const std::string keyword = text_from(key, "keyword");
    for (const Field& field : fields_)
      if (std::string_view(keyword) == field.name) return field.set(config, value);
    std::vector<std::string> known = names();
    known.insert(known.end(), others.begin(), others.end());
    refuse_keyword(keyword, known);
  }

  std::vector<Field> fields_;
};

const Fields<LoadConfig>& load_fields();
const Fields<EsdfConfig>& esdf_fields();
const Fields<GvdConfig>& gvd_fields();
const Fields<GraphConfig>& graph_fields();
const Fields<SimplifyConfig>& simplify_fields();
const Fields<BuildConfig>& build_fields();
const Fields<PlanConfig>& plan_fields();
const Fields<CheckConfig>& check_fields();
const Fields<TrajectoryConfig>& trajectory_fields();
const Fields<FusionConfig>& fusion_fields();
const Fields<LiveConfig>& live_fields();
const Fields<ExplorerConfig>& explorer_fields();
const Fields<PictureConfig>& picture_fields();

}  // namespace ridgeway::python
