// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "map_server.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <vector>

#include "files/text.hpp"
#include "repeated_key.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

class Keys {
 public:
  Keys(const YAML::Node& map, const std::string& name) : map_(map), name_(name) {}

  [[noreturn]] void fail(const YAML::Node& node, const std::string& what,
                         const std::string& remedy) const {
    const YAML::Mark mark = node.Mark();
    const std::string line = mark.is_null() ? "" : " line " + std::to_string(mark.line + 1);
    throw InputError(name_ + line, what, remedy);
  }
  bool has(const char* key) const { return static_cast<bool>(map_[key]); }
  YAML::Node at(const char* key) const {
    const YAML::Node node = map_[key];
    if (!node) throw InputError(name_, "has no " + std::string(key), "give one");
    return node;
  }
  double number(const YAML::Node& node, const char* key) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
      fail(node, "has a " + std::string(key) + " that is no number", "give one");
    return value;
  }
  /// The number of a key between two.
  double number(const char* key, double least, double most, const char* remedy) const {
    const YAML::Node node = at(key);
    const double value = number(node, key);
    if (!(value >= least && value <= most))
      fail(node, "has a " + std::string(key) + " of " + node.Scalar(), remedy);
    return value;
  }
  std::string word(const char* key) const {
    const YAML::Node node = at(key);
    if (!node.IsScalar() || node.Scalar().empty())
      fail(node, "has no text at " + std::string(key), "give one");
    return node.Scalar();
  }

 private:
  YAML::Node map_;
  const std::string& name_;
};

void read_origin(const Keys& keys, MapServerFile& file) {
  const YAML::Node origin = keys.at("origin");
  if (!origin.IsSequence() || origin.size() != 3)
    keys.fail(origin, "has an origin that is no list of three numbers", "give [x, y, yaw]");
  file.x = keys.number(origin[0], "origin");
  file.y = keys.number(origin[1], "origin");
  file.yaw = keys.number(origin[2], "origin");
}

MapServerFile::Mode mode_of(const Keys& keys) {
  const std::string word = keys.word("mode");
  if (word == "trinary") return MapServerFile::Mode::kTrinary;
  if (word == "scale") return MapServerFile::Mode::kScale;
  if (word == "raw") return MapServerFile::Mode::kRaw;
  keys.fail(keys.at("mode"), "has an unknown mode '" + word + "'", "give trinary, scale or raw");
}

MapServerFile read_keys(const Keys& keys) {
  MapServerFile file;
  file.image = keys.word("image");
  file.resolution = keys.number("resolution", 1e-6, 1e6, "give metres a pixel, 0.05 for example");
  read_origin(keys, file);
  if (keys.has("negate")) {
    const std::string word = keys.word("negate");
    if (word != "0" && word != "1" && word != "true" && word != "false")
      keys.fail(keys.at("negate"), "has a negate of '" + word + "'", "give 0 or 1");
    file.negate = word == "1" || word == "true";
  }
  const char* share = "give a number from 0 to 1";
  if (keys.has("occupied_thresh"))
    file.occupied_thresh = keys.number("occupied_thresh", 0.0, 1.0, share);
  if (keys.has("free_thresh")) file.free_thresh = keys.number("free_thresh", 0.0, 1.0, share);
  if (!(file.free_thresh <= file.occupied_thresh))
    keys.fail(keys.at("free_thresh"), "has a free_thresh above occupied_thresh",
              "give a lower one");
  if (keys.has("mode")) file.mode = mode_of(keys);
  return file;
}

}  // namespace

bool is_map_server(std::string_view text) {
  constexpr std::size_t kMost = 16384;  // such files are short
  if (text.size() <= kMost) try {
      const YAML::Node map = YAML::Load(std::string(text));
      // Keys that no world has; one without an image is told so.
      return map.IsMap() && (map["image"] || (map["resolution"] && map["origin"]));
    } catch (const YAML::Exception&) {  // it may be one with a mistake
    }
  return text.substr(0, kMost).find("\nimage:") != text.npos || text.starts_with("image:");
}

MapServerFile read_map_server(std::string_view text, const std::string& name) {
  try {
    const YAML::Node map = YAML::Load(std::string(text));
    if (!map.IsMap()) throw InputError(name, "is no map of keys and values", "write it again");
    const Keys keys(map, name);
    if (const auto again = find_repeated_key(map))
      keys.fail(*again, "has the key '" + again->Scalar() + "' again", "give it once");
    return read_keys(keys);
  } catch (const YAML::Exception& error) {
    throw InputError(name, std::string("is no YAML: ") + error.what(), "correct it");
  }
}

VoxelState state_of_pixel(const MapServerFile& file, std::uint8_t grey, std::uint8_t opaque) {
  const bool is_clear = opaque < 255;
  const bool averages = is_clear && file.mode == MapServerFile::Mode::kTrinary;
  if (is_clear && !averages) return VoxelState::kUnknown;
  const double bright = (averages ? 0.75 * grey + 0.25 * opaque : grey) / 255.0;
  double occupied = file.negate ? bright : 1.0 - bright;
  if (file.mode == MapServerFile::Mode::kRaw) {
    if (grey > 100) return VoxelState::kUnknown;
    occupied = grey / 100.0;
  }
  if (occupied > file.occupied_thresh) return VoxelState::kOccupied;
  return occupied < file.free_thresh && !is_clear ? VoxelState::kFree : VoxelState::kUnknown;
}

}  // namespace ridgeway
