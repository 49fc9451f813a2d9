// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "voxblox.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/number_text.hpp"
#include "files/byte_reader.hpp"
#include "files/text.hpp"
#include "mapping/memory_limit.hpp"
#include "mapping/thin_surfaces.hpp"
#include "protobuf.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

constexpr const char* kLayerDamaged = "the file is damaged, fetch or write it again";
constexpr int kMostSide = 64;
constexpr std::uint32_t kObserved = 1, kSupposed = 2;  // flags of a voxel of an ESDF

struct LayerType {
  std::string_view name;
  int words;
};
constexpr std::array<LayerType, 5> kTypes = {
    {{"tsdf", 3}, {"esdf", 2}, {"occupancy", 2}, {"intensity", 3}, {"skeleton", 3}}};

/// Where in a file something is read, for messages.
struct Place {
  std::string_view bytes;
  const std::string& name;
  std::size_t layer = 0;  ///< from 1
  std::size_t block = 0;  ///< from 1; 0 for the layer's own message

  std::string text() const {
    return name + ", layer " + std::to_string(layer) +
           (block > 0 ? ", block " + std::to_string(block) : std::string());
  }
  ByteReader reader(std::size_t begin, std::size_t end) const {
    return {bytes.substr(0, end), text(), begin};
  }
};

/// Doubles of the original are widened floats: 0.2 is written as 0.20000000298.
double as_meant(double widened) {
  const auto narrow = static_cast<float>(widened);
  if (static_cast<double>(narrow) != widened) return widened;
  return to_number<double>(number_text(narrow)).value_or(widened);
}

VoxbloxLayer read_layer_message(const Place& place, std::size_t begin, std::size_t end) {
  ByteReader reader = place.reader(begin, end);
  VoxbloxLayer layer;
  std::uint64_t side = 0;
  while (reader.remaining() > 0) {
    const ProtobufField field = take_field(reader);
    if (field.number == 1 && field.wire == ProtobufField::kFixed64)
      layer.voxel_size = as_meant(field.as_double());
    if (field.number == 2 && field.wire == ProtobufField::kVarint) side = field.bits;
    if (field.number == 3 && field.wire == ProtobufField::kBytes)
      layer.type = std::string(place.bytes.substr(field.begin, field.end - field.begin));
  }
  if (!(layer.voxel_size >= 1e-6 && layer.voxel_size <= 1e6))
    reader.fail("has voxels of " + number_text(layer.voxel_size) + " m", kLayerDamaged);
  if (side < 1 || side > kMostSide)
    reader.fail("has blocks of " + std::to_string(side) + " voxels a side", kLayerDamaged);
  if (words_per_voxel(layer.type) == 0)
    reader.fail("is of type '" + layer.type.substr(0, 40) + "'",
                "tsdf, esdf, occupancy, intensity and skeleton are known");
  layer.side = static_cast<int>(side);
  return layer;
}

std::uint32_t word_of(const ByteReader& reader, std::uint64_t value) {
  if (value > 0xffffffffu) reader.fail("has a word of more than 32 bits", kLayerDamaged);
  return static_cast<std::uint32_t>(value);
}

VoxelIndex block_index(const ByteReader& reader, const Eigen::Vector3d& origin,
                       const VoxbloxLayer& layer) {
  const double size = layer.voxel_size * layer.side;
  const Eigen::Vector3d at = (origin / size).array().round();
  if (!((at.array().abs() * layer.side) < static_cast<double>(kMaxVoxelIndex)).all())
    reader.fail("has its origin at no place within 1e9 voxels", kLayerDamaged);
  return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
}

VoxbloxBlock read_block(const Place& place, std::size_t begin, std::size_t end,
                        const VoxbloxLayer& layer) {
  const auto count =
      static_cast<std::size_t>(layer.side * layer.side * layer.side * words_per_voxel(layer.type));
  ByteReader reader = place.reader(begin, end);
  VoxbloxBlock block;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::uint64_t side = static_cast<std::uint64_t>(layer.side);
  const auto add = [&](std::uint64_t value) {
    if (block.words.empty()) block.words.reserve(std::min(count, end - begin));
    if (block.words.size() == count)
      reader.fail("has more than " + std::to_string(count) + " words", kLayerDamaged);
    block.words.push_back(word_of(reader, value));
  };
  while (reader.remaining() > 0) {
    const ProtobufField field = take_field(reader);
    if (field.number == 1) side = field.bits;
    if (field.number >= 3 && field.number <= 5) origin[field.number - 3] = field.as_double();
    if (field.number == 6) block.has_data = field.bits != 0;
    if (field.number == 7 && field.wire == ProtobufField::kVarint) add(field.bits);
    if (field.number == 7 && field.wire == ProtobufField::kBytes) {
      ByteReader packed = place.reader(field.begin, field.end);
      while (packed.remaining() > 0) add(take_varint(packed));
    }
  }
  if (side != static_cast<std::uint64_t>(layer.side))
    reader.fail("has " + std::to_string(side) + " voxels a side where its layer has " +
                    std::to_string(layer.side),
                kLayerDamaged);
  if (!block.words.empty() && block.words.size() != count)
    reader.fail("has " + std::to_string(block.words.size()) + " words where " +
                    std::to_string(count) + " are needed",
                kLayerDamaged);
  block.index = block_index(reader, origin, layer);
  return block;
}

/// The end of the message that begins here; the reader goes there.
std::pair<std::size_t, std::size_t> take_message(ByteReader& reader) {
  const std::uint64_t length = take_varint(reader);
  if (length > reader.remaining())
    reader.fail("ends within a message of " + std::to_string(length) + " bytes",
                "the file is cut short, fetch or write it again");
  const std::size_t begin = reader.offset();
  reader.skip(length);
  return {begin, reader.offset()};
}

VoxbloxLayer read_layer(ByteReader& file, Place& place) {
  const std::uint64_t messages = take_varint(file);
  if (messages == 0) file.fail("has a layer without a message", kLayerDamaged);
  place.block = 0;
  const auto next = [&] {
    ByteReader reader(place.bytes, place.text(), file.offset());
    const auto message = take_message(reader);
    file.move_to(message.second);
    return message;
  };
  const auto [begin, end] = next();
  VoxbloxLayer layer = read_layer_message(place, begin, end);
  for (place.block = 1; place.block < messages; ++place.block) {
    const auto [first, last] = next();
    if (layer.blocks.size() == layer.blocks.capacity())  // they may be of a few bytes each
      require_memory(3.0 * sizeof(VoxbloxBlock) * static_cast<double>(layer.blocks.size() + 1),
                     place.text(), "cut the map into parts");
    layer.blocks.push_back(read_block(place, first, last, layer));
  }
  return layer;
}

/// In single precision, as voxblox has it, unless another block would have the same: then in
/// double.
double block_origin(int index, const VoxbloxLayer& layer) {
  const auto size = static_cast<float>(layer.voxel_size) * static_cast<float>(layer.side);
  const auto single = static_cast<double>(static_cast<float>(index) * size);
  const double own = index * (layer.voxel_size * layer.side);
  constexpr double kSurely = 0.25;  // of a block
  return std::abs(single - own) < kSurely * layer.voxel_size * layer.side ? single : own;
}

std::string block_bytes(const VoxbloxLayer& layer, const VoxbloxBlock& block) {
  ProtobufWriter writer;
  writer.whole(1, static_cast<std::uint64_t>(layer.side));
  writer.real(2, static_cast<double>(static_cast<float>(layer.voxel_size)));
  writer.real(3, block_origin(block.index.x, layer));
  writer.real(4, block_origin(block.index.y, layer));
  writer.real(5, block_origin(block.index.z, layer));
  writer.whole(6, block.has_data ? 1 : 0);
  for (const std::uint32_t word : block.words) writer.whole(7, word);
  return writer.bytes();
}

/// What a voxel's words say; nothing where a number is none.
std::optional<VoxelState> state_of(std::string_view type, const std::uint32_t* words) {
  const auto value = std::bit_cast<float>(words[0]);
  const auto weight = std::bit_cast<float>(words[1]);
  bool is_seen = false, is_free = value > 0.0f;
  if (type == "tsdf") {
    if (std::isnan(weight)) return std::nullopt;
    is_seen = weight > kLeastWeight;
  } else if (type == "esdf") {
    is_seen = (words[1] & (kObserved | kSupposed)) == kObserved;
  } else {
    is_seen = words[1] != 0;
    is_free = value < 0.0f;
  }
  if (!is_seen) return VoxelState::kUnknown;
  if (std::isnan(value)) return std::nullopt;
  return is_free ? VoxelState::kFree : VoxelState::kOccupied;
}

/// Calls visit(voxel of the lattice, its words, number of its block) for all that have words.
template <typename Visit>
void for_each_voxel(const VoxbloxLayer& layer, const Visit& visit) {
  const auto words = static_cast<std::size_t>(words_per_voxel(layer.type));
  const int n = layer.side;
  for (std::size_t b = 0; b < layer.blocks.size(); ++b) {
    const VoxbloxBlock& block = layer.blocks[b];
    for (std::size_t i = 0; i * words < block.words.size(); ++i) {
      const int at = static_cast<int>(i);
      visit(VoxelIndex{block.index.x * n + at % n, block.index.y * n + at / n % n,
                       block.index.z * n + at / (n * n)},
            &block.words[i * words], b);
    }
  }
}

bool has_seen_voxels(const VoxbloxLayer& layer) {
  const auto words = static_cast<std::size_t>(words_per_voxel(layer.type));
  for (const VoxbloxBlock& block : layer.blocks)
    for (std::size_t i = 0; i < block.words.size(); i += words)
      if (state_of(layer.type, &block.words[i]) != VoxelState::kUnknown) return true;
  return false;
}

}  // namespace

int words_per_voxel(std::string_view type) {
  for (const LayerType& known : kTypes)
    if (known.name == type) return known.words;
  return 0;
}

bool is_voxblox(std::string_view bytes) {
  // Number of messages, length of the first, its field 1 of eight bytes, its field 2 or 3.
  constexpr std::string_view kNoName;
  ByteReader reader(bytes.substr(0, 64), std::string(kNoName));
  try {
    if (take_varint(reader) == 0) return false;
    const std::uint64_t length = take_varint(reader);
    if (length < 10 || length > 60) return false;
    if (reader.take<std::uint8_t>() != 0x09) return false;
    reader.skip(8);
    const auto tag = reader.take<std::uint8_t>();
    return tag == 0x10 || tag == 0x1a;
  } catch (const InputError&) {
    return false;
  }
}

std::vector<VoxbloxLayer> read_voxblox(std::string_view bytes, const std::string& name) {
  ByteReader file(bytes, name);
  Place place{bytes, name};
  std::vector<VoxbloxLayer> layers;
  while (file.remaining() > 0) {
    ++place.layer;
    layers.push_back(read_layer(file, place));
  }
  return layers;
}

std::string voxblox_bytes(const std::vector<VoxbloxLayer>& layers) {
  ProtobufWriter file;
  for (const VoxbloxLayer& layer : layers) {
    ProtobufWriter head;
    head.real(1, static_cast<double>(static_cast<float>(layer.voxel_size)));
    head.whole(2, static_cast<std::uint64_t>(layer.side));
    head.text(3, layer.type);
    file.varint(1 + layer.blocks.size());
    file.message(head.bytes());
    for (const VoxbloxBlock& block : layer.blocks) file.message(block_bytes(layer, block));
  }
  return file.bytes();
}

const VoxbloxLayer& map_layer(const std::vector<VoxbloxLayer>& layers, const std::string& name) {
  for (const char* type : {"tsdf", "esdf", "occupancy"})
    for (const VoxbloxLayer& layer : layers)
      if (layer.type == type && has_seen_voxels(layer)) return layer;
  std::string held;
  for (const VoxbloxLayer& layer : layers)
    held += (held.empty() ? "" : ", ") + layer.type + " of " + std::to_string(layer.blocks.size()) +
            " blocks";
  throw InputError(name, "holds no layer with voxels that were observed (" + held + ")",
                   "save a TSDF, ESDF or occupancy layer of a map");
}

OccupancyMap map_of_layer(const VoxbloxLayer& layer, const std::string& name) {
  OccupancyBuilder builder(
      layer.voxel_size, {.bytes_per_voxel = kMapBytesPerVoxel + int{sizeof(float)}, .name = name});
  for_each_voxel(layer, [&](const VoxelIndex& voxel, const std::uint32_t* words, std::size_t b) {
    const auto state = state_of(layer.type, words);
    if (!state)
      throw InputError(name,
                       "has a voxel whose value is no number, in block " + std::to_string(b + 1) +
                           " of its layer " + layer.type,
                       kLayerDamaged);
    builder.set(voxel, *state);
  });
  OccupancyMap map = std::move(builder).finish();
  if (layer.type != "tsdf" && layer.type != "esdf") return map;
  VoxelField<float> distance(map.layout, std::numeric_limits<float>::infinity());
  for_each_voxel(layer, [&](const VoxelIndex& voxel, const std::uint32_t* words, std::size_t) {
    if (state_of(layer.type, words) == VoxelState::kUnknown) return;
    float& least = distance[map.layout.find(voxel - map.origin)];
    least = std::min(least, std::bit_cast<float>(words[0]));  // a block may be there twice
  });
  detail::occupy_thin_surfaces(distance, map);
  return map;
}

}  // namespace ridgeway
