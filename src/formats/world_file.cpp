// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/world_file.hpp"

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <string_view>

#include "common/number_text.hpp"
#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "mesh_file.hpp"
#include "repeated_key.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

/// Reads values out of YAML nodes; every complaint names the file and the line.
class WorldReader {
 public:
  explicit WorldReader(const std::filesystem::path& file)
      : name_(file.string()), folder_(std::filesystem::absolute(file).parent_path()) {}

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
    if (const auto again = find_repeated_key(map))
      fail(again->Mark(), "has the key '" + again->Scalar() + "' again",
           "give it once, with all that belongs to it");
  }

  double number(const YAML::Node& map, const char* key) const {
    return scalar(present(map, key), key);
  }

  Eigen::Vector3d vector(const YAML::Node& map, const char* key,
                         const char* remedy = "give [x, y, z] in metres") const {
    const YAML::Node list = present(map, key);
    if (!list.IsSequence() || list.size() != 3)
      fail(list.Mark(), "has a " + std::string(key) + " that is no list of three numbers", remedy);
    return {scalar(list[0], key), scalar(list[1], key), scalar(list[2], key)};
  }

  /// A file beside the one that is read.
  std::filesystem::path file(const YAML::Node& map, const char* key) const {
    const YAML::Node node = present(map, key);
    if (!node.IsScalar() || node.Scalar().empty())
      fail(node.Mark(), "has a " + std::string(key) + " that is no path", "give one");
    return (folder_ / node.Scalar()).lexically_normal();
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
      fail(node.Mark(), "has a " + std::string(key) + " that is no number",
           "give one, without its unit");
    return value;
  }

  std::string name_;
  std::filesystem::path folder_;
};

/// The rotation by roll, pitch and yaw, degrees, yaw applied last.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& degrees) {
  const Eigen::Vector3d angles = degrees * (std::numbers::pi / 180.0);
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d degrees_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d yaw_pitch_roll = rotation.eulerAngles(2, 1, 0);
  return yaw_pitch_roll.reverse() * (180.0 / std::numbers::pi);
}

/// Meshes by their files: each is read once.
using Meshes = std::map<std::filesystem::path, std::shared_ptr<const SolidMesh>>;

PlacedMesh read_mesh(const YAML::Node& node, const WorldReader& reader, Meshes& meshes) {
  reader.require_keys(node, {"file", "scale", "translation", "rotation"});
  PlacedMesh placed;
  if (node["scale"]) placed.scale = reader.number(node, "scale");
  if (!(placed.scale > 0.0))
    reader.fail(node["scale"].Mark(), "has a scale that is not above 0",
                "give 1 for metres, 0.001 for millimetres");
  if (node["translation"]) placed.T_world_mesh.translation() = reader.vector(node, "translation");
  if (node["rotation"])
    placed.T_world_mesh.linear() =
        rotation_of(reader.vector(node, "rotation", "give [roll, pitch, yaw] in degrees"));
  const std::filesystem::path file = reader.file(node, "file");
  std::shared_ptr<const SolidMesh>& mesh = meshes[file];
  try {
    if (mesh == nullptr) mesh = load_mesh(file);
  } catch (const InputError& error) {
    reader.fail(node["file"].Mark(), error.where() + " " + error.problem(), error.remedy());
  }
  placed.mesh = mesh;
  placed.file = file.string();
  return placed;
}

/// Boxes, spheres and cylinders, of a world or of solids that are timed.
template <typename Solids>
void read_round_and_square(const YAML::Node& map, const WorldReader& reader, Solids& solids) {
  reader.for_each(map, "boxes", [&](const YAML::Node& node) {
    reader.require_keys(node, {"centre", "size"});
    solids.boxes.push_back({reader.vector(node, "centre"), reader.vector(node, "size")});
  });
  reader.for_each(map, "spheres", [&](const YAML::Node& node) {
    reader.require_keys(node, {"centre", "radius"});
    solids.spheres.push_back({reader.vector(node, "centre"), reader.number(node, "radius")});
  });
  reader.for_each(map, "cylinders", [&](const YAML::Node& node) {
    reader.require_keys(node, {"centre", "radius", "height"});
    solids.cylinders.push_back({reader.vector(node, "centre"), reader.number(node, "radius"),
                                reader.number(node, "height")});
  });
}

World read_world(const YAML::Node& root, const WorldReader& reader) {
  reader.require_keys(root, {"name", "planes", "boxes", "spheres", "cylinders", "meshes", "timed"});
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
  read_round_and_square(root, reader, world);
  reader.for_each(root, "timed", [&](const YAML::Node& node) {
    reader.require_keys(node, {"from", "until", "boxes", "spheres", "cylinders"});
    TimedSolids timed;
    if (node["from"]) timed.from = reader.number(node, "from");
    if (node["until"]) timed.until = reader.number(node, "until");
    read_round_and_square(node, reader, timed);
    world.timed.push_back(std::move(timed));
  });
  Meshes meshes;
  reader.for_each(root, "meshes", [&](const YAML::Node& node) {
    world.meshes.push_back(read_mesh(node, reader, meshes));
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
std::string list_of(const std::string& key, const Solids& solids, const Line& line) {
  if (solids.empty()) return {};
  const std::string indent(key.find_first_not_of(' '), ' ');
  std::string text = key + ":\n";
  for (const auto& solid : solids) text += indent + "  - {" + line(solid) + "}\n";
  return text;
}

template <typename Solids>
std::string round_and_square(const std::string& indent, const Solids& solids) {
  return list_of(indent + "boxes", solids.boxes,
                 [](const SolidBox& box) {
                   return "centre: " + text_of(box.centre) + ", size: " + text_of(box.size);
                 }) +
         list_of(indent + "spheres", solids.spheres,
                 [](const SolidSphere& sphere) {
                   return "centre: " + text_of(sphere.centre) +
                          ", radius: " + number_text(sphere.radius);
                 }) +
         list_of(indent + "cylinders", solids.cylinders, [](const SolidCylinder& cylinder) {
           return "centre: " + text_of(cylinder.centre) +
                  ", radius: " + number_text(cylinder.radius) +
                  ", height: " + number_text(cylinder.height);
         });
}

/// As a list entry, of which keys follow below each other.
std::string text_of(const TimedSolids& timed) {
  std::string text;
  if (std::isfinite(timed.from)) text += "    from: " + number_text(timed.from) + "\n";
  if (std::isfinite(timed.until)) text += "    until: " + number_text(timed.until) + "\n";
  text += round_and_square("    ", timed);
  if (text.empty()) return "  - {}\n";
  return "  - " + text.substr(4);
}

}  // namespace

World load_world(const std::filesystem::path& file) {
  const WorldReader reader(file);
  const std::string text = read_file(file);
  try {
    World world = read_world(YAML::Load(text), reader);
    validate_world(world);
    return world;
  } catch (const YAML::Exception& error) {
    reader.fail(error.mark, "is no YAML: " + error.msg,
                "give a world; a mesh is one where a world names it under meshes");
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
  text += round_and_square("", world);
  if (!world.timed.empty()) text += "timed:\n";
  for (const TimedSolids& timed : world.timed) text += text_of(timed);
  text += list_of("meshes", world.meshes, [](const PlacedMesh& placed) {
    if (placed.file.empty())
      throw InputError("mesh", "comes from no file", "save its triangles to one and read that");
    return "file: " + quoted(placed.file) + ", scale: " + number_text(placed.scale) +
           ", translation: " + text_of(placed.T_world_mesh.translation()) +
           ", rotation: " + text_of(degrees_of(placed.T_world_mesh.linear()));
  });
  return text;
}

void save_world(const World& world, const std::filesystem::path& file) {
  validate_world(world);
  write_text_file(file, world_yaml(world));
}

}  // namespace ridgeway
