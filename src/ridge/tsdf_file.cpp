// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/little_endian.hpp"
#include "mapping/memory_limit.hpp"
#include "ridge_container.hpp"
#include "ridge_origin.hpp"
#include "ridge_sections.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

namespace ridgeway {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kChunkVoxels = std::size_t{128} * kBlockVoxels;
constexpr const char* kContent = "tsdf";

std::size_t chunk_count(std::size_t voxels) { return (voxels + kChunkVoxels - 1) / kChunkVoxels; }

RidgeSectionSource field_section(const TsdfMap& map) {
  return {kContent, kTsdfType, chunk_count(map.layout.voxel_count()),
          [&map](std::size_t chunk, std::vector<std::byte>& raw) {
            const std::size_t first = chunk * kChunkVoxels;
            const std::size_t end = std::min(first + kChunkVoxels, map.layout.voxel_count());
            for (const auto* field : {&map.distance, &map.weight})
              for (std::size_t order = first; order < end; ++order)
                append_number(
                    raw, (*field)[map.layout.voxel_at_order(static_cast<std::uint32_t>(order))]);
          }};
}

struct TsdfHeader {
  double voxel_size = 0.0;
  VoxelIndex origin;
  double truncation = 0.0;
  std::uint32_t blocks = 0;
};

TsdfHeader parse_tsdf_header(const RidgeReader& reader) {
  TsdfHeader header;
  try {
    const Json json = Json::parse(reader.header());
    if (const auto content = json.at("content").get<std::string>(); content != kContent)
      throw InputError(reader.path(), "holds a '" + content + "', not a fused map",
                       "make one with `ridgeway fuse`");
    header = {json.at("voxel_size").get<double>(), origin_in(json),
              json.at("truncation").get<double>(),
              json.at("counts").at("blocks").get<std::uint32_t>()};
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    reader.damaged("header", std::string("is not readable: ") + error.what());
  }
  if (!(header.voxel_size > 0.0 && std::isfinite(header.voxel_size) &&
        header.truncation >= header.voxel_size && std::isfinite(header.truncation)))
    reader.damaged("header", "has no positive voxel size and truncation");
  return header;
}

void load_chunk(const RidgeReader& reader, const std::vector<std::byte>& raw, std::size_t first,
                std::size_t count, TsdfMap& map) {
  if (raw.size() != 2 * count * sizeof(float)) reader.damaged(kContent, "has a wrong size");
  const auto most = static_cast<float>(map.truncation * (1.0 + 1e-6));
  for (std::size_t i = 0; i < count; ++i) {
    const auto distance = number_at<float>(raw, 0, i), weight = number_at<float>(raw, 0, count + i);
    if (!(std::abs(distance) <= most) || !(weight >= 0.0f && std::isfinite(weight)))
      reader.damaged(kContent, "has a value that is no distance or weight");
    map.distance[static_cast<VoxelId>(first + i)] = distance;
    map.weight[static_cast<VoxelId>(first + i)] = weight;
  }
}

}  // namespace

void save_tsdf(const TsdfMap& map, const std::string& source, const std::filesystem::path& path) {
  const Json header = {{"content", kContent},
                       {"voxel_size", map.voxel_size},
                       {"origin", json_of_origin(map.origin)},
                       {"truncation", map.truncation},
                       {"source", source},
                       {"counts", {{"blocks", map.layout.block_count()}}}};
  const std::vector<RidgeSectionSource> sections = {blocks_section(map.layout), field_section(map)};
  write_ridge_container(path, header.dump(1, ' ', false, Json::error_handler_t::replace) + "\n",
                        sections);
}

TsdfMap load_tsdf(const std::filesystem::path& path) {
  constexpr int kBytesPerVoxel = 2 * sizeof(float);
  const RidgeReader reader(path);
  const TsdfHeader header = parse_tsdf_header(reader);
  const RidgeSectionEntry& section = reader.get_section(kContent, kTsdfType);
  const std::size_t voxels = std::size_t{header.blocks} * kBlockVoxels;
  if (section.raw_bytes != voxels * kBytesPerVoxel || section.chunks.size() != chunk_count(voxels))
    reader.damaged(kContent, "does not fit the number of blocks");
  require_memory_for_blocks(header.blocks, kBytesPerVoxel, reader.path());
  TsdfMap map{.voxel_size = header.voxel_size,
              .origin = header.origin,
              .truncation = header.truncation,
              .layout = load_blocks(reader, header.blocks),
              .distance = {},
              .weight = {}};
  map.distance = VoxelField<float>(map.layout);
  map.weight = VoxelField<float>(map.layout);
  RidgeReader::Scratch scratch;
  std::vector<std::byte> raw;
  for (std::size_t chunk = 0; chunk < section.chunks.size(); ++chunk) {
    reader.read_chunk(section, chunk, scratch, raw);
    const std::size_t first = chunk * kChunkVoxels;
    load_chunk(reader, raw, first, std::min(kChunkVoxels, voxels - first), map);
  }
  return map;
}

bool is_tsdf_file(const std::filesystem::path& path) {
  try {
    const RidgeReader reader(path);
    const Json json = Json::parse(reader.header(), nullptr, false);
    return json.is_object() && json.value("content", Json()) == kContent;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace ridgeway
