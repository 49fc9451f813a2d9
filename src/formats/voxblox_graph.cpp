// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "voxblox_graph.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "files/byte_reader.hpp"
#include "protobuf.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

constexpr const char* kGraphDamaged = "the file is damaged, fetch or write it again";
constexpr double kSamePlace = 1e-3;  // metres

VoxbloxGraph::Vertex read_vertex(ByteReader reader, std::string_view bytes) {
  VoxbloxGraph::Vertex vertex;
  while (reader.remaining() > 0) {
    const ProtobufField field = take_field(reader);
    if (field.number == 1) vertex.id = field.as_signed();
    if (field.number >= 2 && field.number <= 4) vertex.place[field.number - 2] = field.as_double();
    if (field.number == 5 && field.wire == ProtobufField::kVarint)
      vertex.edges.push_back(field.as_signed());
    if (field.number == 5 && field.wire == ProtobufField::kBytes) {
      ByteReader packed(bytes.substr(0, field.end), reader.name(), field.begin);
      while (packed.remaining() > 0)
        vertex.edges.push_back(static_cast<std::int64_t>(take_varint(packed)));
    }
    if (field.number == 6) vertex.subgraph = field.as_signed();
  }
  return vertex;
}

VoxbloxGraph::Edge read_edge(ByteReader reader) {
  VoxbloxGraph::Edge edge;
  while (reader.remaining() > 0) {
    const ProtobufField field = take_field(reader);
    const std::uint32_t n = field.number;
    if (n == 1) edge.id = field.as_signed();
    if (n == 2) edge.from = field.as_signed();
    if (n == 3) edge.to = field.as_signed();
    if (n >= 4 && n <= 6) edge.start[n - 4] = field.as_double();
    if (n >= 7 && n <= 9) edge.end[n - 7] = field.as_double();
    if (n == 10) edge.start_distance = field.as_float();
    if (n == 11) edge.end_distance = field.as_float();
  }
  return edge;
}

bool lists(const VoxbloxGraph::Vertex& vertex, std::int64_t edge) {
  return std::find(vertex.edges.begin(), vertex.edges.end(), edge) != vertex.edges.end();
}

/// Vertices by id; of those with the same one the first.
class VertexTable {
 public:
  explicit VertexTable(const VoxbloxGraph& graph) : graph_(graph) {
    for (std::uint32_t i = 0; i < graph.vertices.size(); ++i)
      doubled_ += !places_.emplace(graph.vertices[i].id, i).second;
  }
  const VoxbloxGraph::Vertex* find(std::int64_t id) const {
    const auto at = places_.find(id);
    return at == places_.end() ? nullptr : &graph_.vertices[at->second];
  }
  std::size_t doubled() const { return doubled_; }

 private:
  const VoxbloxGraph& graph_;
  std::unordered_map<std::int64_t, std::uint32_t> places_;
  std::size_t doubled_ = 0;
};

}  // namespace

bool is_voxblox_graph(std::string_view bytes) {
  ByteReader reader(bytes, {});
  try {
    if (take_varint(reader) != reader.remaining() || reader.remaining() < 2) return false;
    const auto tag = reader.take<std::uint8_t>();
    if (tag != 0x0a && tag != 0x12) return false;
    return take_varint(reader) <= reader.remaining() && reader.remaining() > 0 &&
           reader.take<std::uint8_t>() == 0x08;  // the id of a vertex or an edge
  } catch (const InputError&) {
    return false;
  }
}

VoxbloxGraph read_voxblox_graph(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  const std::uint64_t length = take_varint(reader);
  if (length != reader.remaining())
    reader.fail("says that " + std::to_string(length) + " bytes follow where " +
                    std::to_string(reader.remaining()) + " do",
                kGraphDamaged);
  VoxbloxGraph graph;
  while (reader.remaining() > 0) {
    const ProtobufField field = take_field(reader);
    if (field.wire != ProtobufField::kBytes) continue;
    const std::string_view until = bytes.substr(0, field.end);
    if (field.number == 1) graph.vertices.push_back(read_vertex({until, name, field.begin}, until));
    if (field.number == 2) graph.edges.push_back(read_edge({until, name, field.begin}));
  }
  return graph;
}

std::string voxblox_graph_bytes(const VoxbloxGraph& graph) {
  const auto bits = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  ProtobufWriter all, file;
  for (const VoxbloxGraph::Vertex& vertex : graph.vertices) {
    ProtobufWriter writer;
    writer.whole(1, bits(vertex.id));
    for (int axis = 0; axis < 3; ++axis)
      writer.real(2 + static_cast<std::uint32_t>(axis), vertex.place[axis]);
    for (const std::int64_t edge : vertex.edges) writer.whole(5, bits(edge));
    writer.whole(6, bits(vertex.subgraph));
    all.text(1, writer.bytes());
  }
  for (const VoxbloxGraph::Edge& edge : graph.edges) {
    ProtobufWriter writer;
    writer.whole(1, bits(edge.id));
    writer.whole(2, bits(edge.from));
    writer.whole(3, bits(edge.to));
    for (int axis = 0; axis < 3; ++axis)
      writer.real(4 + static_cast<std::uint32_t>(axis), edge.start[axis]);
    for (int axis = 0; axis < 3; ++axis)
      writer.real(7 + static_cast<std::uint32_t>(axis), edge.end[axis]);
    writer.single(10, edge.start_distance);
    writer.single(11, edge.end_distance);
    all.text(2, writer.bytes());
  }
  file.message(all.bytes());
  return file.bytes();
}

VoxbloxGraphFaults find_faults(const VoxbloxGraph& graph) {
  const VertexTable table(graph);
  VoxbloxGraphFaults faults;
  faults.doubled_ids = table.doubled();
  std::set<std::int64_t> ids, joined_vertices;
  std::set<std::pair<std::int64_t, std::int64_t>> pairs;
  DisjointSets parts(graph.vertices.size());
  const auto place_of = [&](const VoxbloxGraph::Vertex* vertex) {
    return static_cast<std::uint32_t>(vertex - graph.vertices.data());
  };
  for (const VoxbloxGraph::Edge& edge : graph.edges) {
    faults.doubled_ids += !ids.insert(edge.id).second;
    faults.not_finite += !edge.start.allFinite() || !edge.end.allFinite();
    const VoxbloxGraph::Vertex *from = table.find(edge.from), *to = table.find(edge.to);
    if (from == nullptr || to == nullptr) {
      ++faults.dangling_edges;
      continue;
    }
    joined_vertices.insert({edge.from, edge.to});
    parts.join(place_of(from), place_of(to));
    faults.misplaced_ends += !((edge.start - from->place).norm() <= kSamePlace);
    faults.misplaced_ends += !((edge.end - to->place).norm() <= kSamePlace);
    faults.unlisted_edges += !lists(*from, edge.id) || !lists(*to, edge.id);
    if (edge.from == edge.to)
      ++faults.self_loops;
    else
      faults.doubled_edges += !pairs.insert(std::minmax(edge.from, edge.to)).second;
  }
  std::set<std::uint32_t> roots;
  for (std::uint32_t i = 0; i < graph.vertices.size(); ++i) {
    roots.insert(parts.find(i));
    faults.not_finite += !graph.vertices[i].place.allFinite();
    faults.lone_vertices += !joined_vertices.contains(graph.vertices[i].id);
  }
  faults.components = roots.size();
  return faults;
}

}  // namespace ridgeway
