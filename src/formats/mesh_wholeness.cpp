// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mesh_wholeness.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "files/little_endian.hpp"
#include "mapping/memory_limit.hpp"
#include "mesh_file.hpp"
#include "ply_cloud.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using nlohmann::json;

/// The JSON of a .glb: the first chunk, after a header of 12 bytes and its own of 8. Empty where
/// the file ends before that.
std::string_view json_of_glb(std::string_view bytes) {
  constexpr std::size_t kHeaders = 20;
  if (bytes.size() < kHeaders) return {};
  const auto size = number_at<std::uint32_t>(std::as_bytes(std::span(bytes)), 12);
  return bytes.substr(kHeaders, size);
}

/// A member of an object, or null.
const json& member(const json& object, const char* name) {
  static const json none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

void refuse_extension(const std::string& extension, const std::string& name) {
  throw InputError(name, "needs the extension '" + extension + "' of glTF",
                   "write it without compression, quantisation and instances");
}

/// glTF has a reader refuse what is required and not known to it. Colours and lights are no matter.
void require_known_extensions(const json& gltf, const std::string& name) {
  constexpr std::array kOfLooks = {"KHR_materials_", "KHR_texture_", "KHR_lights_"};
  for (const json& required : member(gltf, "extensionsRequired"))
    if (const auto* extension = required.get_ptr<const std::string*>())
      if (std::none_of(kOfLooks.begin(), kOfLooks.end(),
                       [&](const char* prefix) { return extension->starts_with(prefix); }))
        refuse_extension(*extension, name);
  constexpr const char* kInstances = "EXT_mesh_gpu_instancing";
  for (const json& node : member(gltf, "nodes"))
    if (!member(member(node, "extensions"), kInstances).is_null())
      refuse_extension(kInstances, name);
}

void require_one_file(const json& gltf, const std::string& name) {
  for (const json& buffer : member(gltf, "buffers"))
    if (const auto* uri = member(buffer, "uri").get_ptr<const std::string*>();
        uri != nullptr && !uri->starts_with("data:"))
      throw InputError(name, "has its numbers in another file, '" + *uri + "'",
                       "write it as .glb, which is one file");
}

/// What is no JSON is left to the reader, which says best what is wrong.
void require_whole_gltf(std::string_view text, const std::string& name) {
  constexpr double kBytes = 100.0;  // of a value, the memory around it too
  const auto values = std::count_if(text.begin(), text.end(),
                                    [](char c) { return c == '[' || c == '{' || c == ','; });
  require_memory(kBytes * static_cast<double>(values), name, "give a smaller file");
  const json gltf = json::parse(text, nullptr, false);
  require_known_extensions(gltf, name);
  require_one_file(gltf, name);
}

void require_no_curved_surface(std::string_view text, const std::string& name) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with("surf ") || line.starts_with("surf\t"))
      throw InputError(name, "has curved surfaces", "write them as triangles");
    at = end + 1;
  }
}

/// Where header and size disagree, triangles are missing, or what the header says is wrong.
void require_stl_of_its_size(std::string_view bytes, const std::string& name) {
  if (is_text_stl(bytes) || bytes.size() < kStlHeader) return;
  const auto count = number_at<std::uint32_t>(std::as_bytes(std::span(bytes)), kStlHeader - 4);
  const std::size_t expected = kStlHeader + kStlTriangle * std::size_t{count};
  if (bytes.size() != expected)
    throw InputError(name,
                     "says that it has " + std::to_string(count) + " triangles, which are " +
                         std::to_string(expected) + " bytes, and has " +
                         std::to_string(bytes.size()),
                     "copy it again, or write it again");
}

}  // namespace

void require_read_whole(std::string_view bytes, const std::string& format,
                        const std::string& name) {
  if (format == "ply") require_one_list_of_faces(bytes, name);
  if (format == "gltf") require_whole_gltf(bytes, name);
  if (format == "glb") require_whole_gltf(json_of_glb(bytes), name);
  if (format == "obj") require_no_curved_surface(bytes, name);
  if (format == "stl") require_stl_of_its_size(bytes, name);
}

}  // namespace ridgeway
