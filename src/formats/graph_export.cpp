// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/graph_export.hpp"

#include <cmath>
#include <vector>

#include "common/number_text.hpp"
#include "files/atomic_file.hpp"
#include "files/little_endian.hpp"
#include "files/text.hpp"
#include "pictures/colour_map.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Bytes = std::vector<std::byte>;

std::string json_number(double value) { return std::isfinite(value) ? number_text(value) : "null"; }

/// As XML Schema writes a double.
std::string xml_number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0.0 ? "INF" : "-INF";
  return number_text(value);
}

std::string data_element(const char* key, double value) {
  return std::string("<data key=\"") + key + "\">" + xml_number(value) + "</data>";
}

void append_text(Bytes& bytes, const std::string& text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

const char* const kPlyVertexProperties =
    "property double x\nproperty double y\nproperty double z\nproperty double clearance\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";

/// A coloured point; `widest` is the clearance at the ramp's end.
void append_ply_vertex(Bytes& bytes, const Point& p, double clearance, double widest) {
  append_number(bytes, p.x());
  append_number(bytes, p.y());
  append_number(bytes, p.z());
  append_number(bytes, clearance);
  for (const std::uint8_t part : bytes_of(ramp_colour(clearance / widest))) {
    append_number(bytes, part);
  }
}

double widest_clearance(const std::vector<double>& clearances) {
  double widest = 1e-9;
  for (const double c : clearances)
    if (std::isfinite(c) && c > widest) widest = c;
  return widest;
}

void write_bytes(const std::filesystem::path& path, const Bytes& bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace

void write_graph_json(const Roadmap& roadmap, const std::filesystem::path& path) {
  const SparseGraph& graph = roadmap.graph;
  std::string text = "{\n\"directed\": false,\n\"multigraph\": false,\n\"graph\": {";
  text += "\"min_clearance\": " + json_number(graph.min_clearance) + "},\n\"nodes\": [";
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    const Vertex& v = graph.vertices[i];
    const Point place = to_world(roadmap.esdf, v.position);
    text += i == 0 ? "\n" : ",\n";
    text += "{\"id\": " + number_text(i) + ", \"x\": " + json_number(place.x()) +
            ", \"y\": " + json_number(place.y()) + ", \"z\": " + json_number(place.z()) +
            ", \"clearance\": " + json_number(v.clearance) + "}";
  }
  text += "],\n\"links\": [";
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const Edge& edge = graph.edges[i];
    text += i == 0 ? "\n" : ",\n";
    text += "{\"source\": " + number_text(number(edge.from)) +
            ", \"target\": " + number_text(number(edge.to)) +
            ", \"length\": " + json_number(edge.length) +
            ", \"clearance\": " + json_number(edge.clearance) + "}";
  }
  text += "]\n}\n";
  write_text_file(path, text);
}

void write_graph_graphml(const Roadmap& roadmap, const std::filesystem::path& path) {
  const SparseGraph& graph = roadmap.graph;
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n"
      "<key id=\"m\" for=\"graph\" attr.name=\"min_clearance\" attr.type=\"double\"/>\n"
      "<key id=\"x\" for=\"node\" attr.name=\"x\" attr.type=\"double\"/>\n"
      "<key id=\"y\" for=\"node\" attr.name=\"y\" attr.type=\"double\"/>\n"
      "<key id=\"z\" for=\"node\" attr.name=\"z\" attr.type=\"double\"/>\n"
      "<key id=\"c\" for=\"node\" attr.name=\"clearance\" attr.type=\"double\"/>\n"
      "<key id=\"l\" for=\"edge\" attr.name=\"length\" attr.type=\"double\"/>\n"
      "<key id=\"d\" for=\"edge\" attr.name=\"clearance\" attr.type=\"double\"/>\n"
      "<graph id=\"G\" edgedefault=\"undirected\">\n";
  text += data_element("m", graph.min_clearance) + "\n";
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    const Vertex& v = graph.vertices[i];
    const Point place = to_world(roadmap.esdf, v.position);
    text += "<node id=\"n" + number_text(i) + "\">" + data_element("x", place.x()) +
            data_element("y", place.y()) + data_element("z", place.z()) +
            data_element("c", v.clearance) + "</node>\n";
  }
  for (const Edge& edge : graph.edges) {
    text += "<edge source=\"n" + number_text(number(edge.from)) + "\" target=\"n" +
            number_text(number(edge.to)) + "\">" + data_element("l", edge.length) +
            data_element("d", edge.clearance) + "</edge>\n";
  }
  text += "</graph>\n</graphml>\n";
  write_text_file(path, text);
}

void write_graph_ply(const Roadmap& roadmap, const std::filesystem::path& path) {
  const SparseGraph& graph = roadmap.graph;
  std::vector<double> clearances;
  for (const Vertex& v : graph.vertices) clearances.push_back(v.clearance);
  const double widest = widest_clearance(clearances);
  Bytes bytes;
  append_text(bytes, "ply\nformat binary_little_endian 1.0\ncomment sparse graph, metres\n");
  append_text(bytes, "element vertex " + number_text(graph.vertices.size()) + "\n");
  append_text(bytes, kPlyVertexProperties);
  append_text(bytes, "element edge " + number_text(graph.edges.size()) +
                         "\nproperty int vertex1\nproperty int vertex2\n"
                         "property double clearance\nend_header\n");
  for (const Vertex& v : graph.vertices) {
    append_ply_vertex(bytes, to_world(roadmap.esdf, v.position), v.clearance, widest);
  }
  for (const Edge& edge : graph.edges) {
    append_number(bytes, static_cast<std::uint32_t>(edge.from));
    append_number(bytes, static_cast<std::uint32_t>(edge.to));
    append_number(bytes, edge.clearance);
  }
  write_bytes(path, bytes);
}

void write_diagram_ply(const Roadmap& roadmap, const std::filesystem::path& path) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::vector<VoxelId> voxels = roadmap.diagram.voxels.members(esdf.layout);
  std::vector<double> clearances;
  clearances.reserve(voxels.size());
  for (const VoxelId id : voxels) clearances.push_back(esdf.distance(id));
  const double widest = widest_clearance(clearances);
  Bytes bytes;
  append_text(bytes, "ply\nformat binary_little_endian 1.0\ncomment skeleton diagram, metres\n");
  append_text(bytes, "element vertex " + number_text(voxels.size()) + "\n");
  append_text(bytes, std::string(kPlyVertexProperties) + "end_header\n");
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const Point centre = centre_of(esdf.layout.index_of(voxels[i]), esdf.voxel_size);
    append_ply_vertex(bytes, to_world(esdf, centre), clearances[i], widest);
  }
  write_bytes(path, bytes);
}

void write_graph(const Roadmap& roadmap, const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".json") return write_graph_json(roadmap, path);
  if (extension == ".graphml") return write_graph_graphml(roadmap, path);
  if (extension == ".ply") return write_graph_ply(roadmap, path);
  if (extension == ".pb") return write_graph_voxblox(roadmap, path);
  throw InputError(path.string(), "names no format that a graph can be written in",
                   "use .json, .graphml, .ply or .pb");
}

}  // namespace ridgeway
