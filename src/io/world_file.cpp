// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/io/world_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"
#include "ridgeway/io/atomic_file.hpp"
#include "ridgeway/io/read_file.hpp"

namespace ridgeway {
namespace {

/// Reads values out of YAML nodes; every complaint names the file and the line.
class WorldReader {
 public:
  explicit WorldReader(std::string name) : name_(std::move(name)) {}

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what,
                         const std::string& remedy) const {
    const std::string line = mark.is_null() ? "" : " line " + std::to_string(mark.line + 1);
    throw InputError(name_ + line, what, remedy);
  }

  void require_keys(const YAML::Node& map, std::initializer_list<std::string_view> known) const {
    std::string list;
    for (const std::string_view key : known) list.append(list.empty() ? "" : ", ").append(key);
    if (!map.IsMap()) fail(map.Mark(), "is no map of keys and values", "give " + list);
    for (const auto& entry : map) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (std::find(known.begin(), known.end(), key) == known.end())
        fail(entry.first.Mark(), "has an unknown key '" + key + "'", "known are " + list);
    }
  }

  double number(const YAML::Node& map, const char* key) const {
    return scalar(present(map, key), key);
  }

  Eigen::Vector3d vector(const YAML::Node& map, const char* key) const {
    const YAML::Node list = present(map, key);
    if (!list.IsSequence() || list.size() != 3)
      fail(list.Mark(), "has a " + std::string(key) + " that is no list of three numbers",
           "give [x, y, z] in metres");
    return {scalar(list[0], key), scalar(list[1], key), scalar(list[2], key)};
  }

  /// Calls read(node) for every entry of a list that may be left out.
  template <typename Read>
  void for_each(const YAML::Node& map, const char* key, const Read& read) const {
    const YAML::Node list = map[key];
    if (!list || list.IsNull()) return;
    if (!list.IsSequence())
      fail(list.Mark(), "has " + std::string(key) + " that are no list", "begin each with '- '");
    for (const YAML::Node& entry : list) read(entry);
  }

 private:
  YAML::Node present(const YAML::Node& map, const char* key) const {
    const YAML::Node node = map[key];
    if (!node) fail(map.Mark(), "has no " + std::string(key), "give one");
    return node;
  }

  double scalar(const YAML::Node& node, const char* key) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
      fail(node.Mark(), "has a " + std::string(key) + " that is no number", "give metres");
    return value;
  }

  std::string name_;
};

World read_world(const YAML::Node& root, const WorldReader& reader) {
  reader.require_keys(root, {"name", "planes", "boxes", "spheres", "cylinders"});
  World world;
  if (const YAML::Node name = root["name"]; name && name.IsScalar()) world.name = name.Scalar();
  reader.for_each(root, "planes", [&](const YAML::Node& node) {
    reader.require_keys(node, {"point", "normal"});
    const Eigen::Vector3d direction = reader.vector(node, "normal");
    if (!(direction.norm() > 0.0))
      reader.fail(node.Mark(), "has a normal of length 0", "give the direction into the open");
    const Eigen::Vector3d normal = direction.normalized();
    world.planes.push_back({normal, normal.dot(reader.vector(node, "point"))});
  });
  reader.for_each(root, "boxes", [&](const YAML::Node& node) {
    reader.require_keys(node, {"centre", "size"});
    world.boxes.push_back({reader.vector(node, "centre"), reader.vector(node, "size")});
  });
  reader.for_each(root, "spheres", [&](const YAML::Node& node) {
    reader.require_keys(node, {"centre", "radius"});
    world.spheres.push_back({reader.vector(node, "centre"), reader.number(node, "radius")});
  });
  reader.for_each(root, "cylinders", [&](const YAML::Node& node) {
    reader.require_keys(node, {"centre", "radius", "height"});
    world.cylinders.push_back({reader.vector(node, "centre"), reader.number(node, "radius"),
                               reader.number(node, "height")});
  });
  return world;
}

std::string text_of(const Eigen::Vector3d& v) {
  return "[" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) + "]";
}

std::string quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

template <typename Solids, typename Line>
std::string list_of(const char* key, const Solids& solids, const Line& line) {
  if (solids.empty()) return {};
  std::string text = std::string(key) + ":\n";
  for (const auto& solid : solids) text += "  - {" + line(solid) + "}\n";
  return text;
}

}  // namespace

World load_world(const std::filesystem::path& file) {
  const WorldReader reader(file.string());
  const std::string text = read_file(file);
  try {
    World world = read_world(YAML::Load(text), reader);
    validate_world(world);
    return world;
  } catch (const YAML::Exception& error) {
    reader.fail(error.mark, "is no YAML: " + error.msg, "see the worlds that come with Ridgeway");
  } catch (const InputError& error) {
    if (error.where().starts_with(file.string())) throw;
    throw error.within(file.string());
  }
}

std::string world_yaml(const World& world) {
  std::string text = "name: " + quoted(world.name) + "\n";
  text += list_of("planes", world.planes, [](const SolidPlane& plane) {
    return "point: " + text_of(plane.normal * plane.offset) + ", normal: " + text_of(plane.normal);
  });
  text += list_of("boxes", world.boxes, [](const SolidBox& box) {
    return "centre: " + text_of(box.centre) + ", size: " + text_of(box.size);
  });
  text += list_of("spheres", world.spheres, [](const SolidSphere& sphere) {
    return "centre: " + text_of(sphere.centre) + ", radius: " + number_text(sphere.radius);
  });
  text += list_of("cylinders", world.cylinders, [](const SolidCylinder& cylinder) {
    return "centre: " + text_of(cylinder.centre) + ", radius: " + number_text(cylinder.radius) +
           ", height: " + number_text(cylinder.height);
  });
  return text;
}

void save_world(const World& world, const std::filesystem::path& file) {
  validate_world(world);
  write_text_file(file, world_yaml(world));
}

}  // namespace ridgeway
