// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/graph_export.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "ridgeway/common/error.hpp"
#include "support/synthetic_roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// Whether every opened element is closed in the reverse order. Enough for what we write.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos || xml.find('<', at + 1) < end) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.front() == '?' || tag.back() == '/') continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.front() != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(GraphExport, JsonIsNodeLinkData) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  const SparseGraph& graph = roadmap.graph;
  write_graph(roadmap, folder / "graph.json");
  const auto json = nlohmann::json::parse(read_whole(folder / "graph.json"));
  EXPECT_EQ(json.at("directed"), false);
  EXPECT_EQ(json.at("multigraph"), false);
  EXPECT_EQ(json.at("graph").at("min_clearance"), graph.min_clearance);
  ASSERT_EQ(json.at("nodes").size(), graph.vertices.size());
  ASSERT_EQ(json.at("links").size(), graph.edges.size());
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    const auto& node = json.at("nodes")[i];
    EXPECT_EQ(node.at("id"), i);
    const Point place = to_world(roadmap.esdf, graph.vertices[i].position);
    EXPECT_EQ(node.at("x").get<double>(), place.x());
    EXPECT_EQ(node.at("z").get<double>(), place.z());
    EXPECT_EQ(node.at("clearance").get<double>(), graph.vertices[i].clearance);
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& link = json.at("links")[i];
    EXPECT_EQ(link.at("source"), number(graph.edges[i].from));
    EXPECT_EQ(link.at("target"), number(graph.edges[i].to));
    EXPECT_EQ(link.at("length").get<double>(), graph.edges[i].length);
    EXPECT_EQ(link.at("clearance").get<double>(), graph.edges[i].clearance);
  }
}

TEST(GraphExport, InfiniteClearanceIsNull) {
  const TemporaryFolder folder;
  Roadmap roadmap = synthetic_roadmap();
  roadmap.graph.vertices[0].clearance = std::numeric_limits<double>::infinity();
  write_graph(roadmap, folder / "graph.json");
  const auto json = nlohmann::json::parse(read_whole(folder / "graph.json"));
  EXPECT_TRUE(json.at("nodes")[0].at("clearance").is_null());
  write_graph(roadmap, folder / "graph.graphml");
  EXPECT_EQ(count(read_whole(folder / "graph.graphml"), ">INF<"), 1u);
}

TEST(GraphExport, GraphmlIsWellFormedAndWhole) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  write_graph(roadmap, folder / "graph.graphml");
  const std::string xml = read_whole(folder / "graph.graphml");
  EXPECT_TRUE(is_well_formed(xml));
  EXPECT_EQ(count(xml, "<node "), roadmap.graph.vertices.size());
  EXPECT_EQ(count(xml, "<edge "), roadmap.graph.edges.size());
}

TEST(GraphExport, PlyHasWhatItsHeaderPromises) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  write_graph(roadmap, folder / "graph.ply");
  const std::string graph = read_whole(folder / "graph.ply");
  const std::size_t body = graph.find("end_header\n") + 11;
  EXPECT_EQ(graph.size() - body,
            35 * roadmap.graph.vertices.size() + 16 * roadmap.graph.edges.size());
  double x = 0.0;
  std::memcpy(&x, graph.data() + body, 8);
  EXPECT_EQ(x, to_world(roadmap.esdf, roadmap.graph.vertices[0].position).x());

  write_diagram_ply(roadmap, folder / "diagram.ply");
  const std::string diagram = read_whole(folder / "diagram.ply");
  EXPECT_EQ(diagram.size() - diagram.find("end_header\n") - 11,
            35 * roadmap.diagram.voxels.count());
}

TEST(GraphExport, AnEmptyGraphIsFine) {
  const TemporaryFolder folder;
  write_graph({}, folder / "graph.json");
  write_graph({}, folder / "graph.ply");
  write_graph({}, folder / "graph.graphml");
  EXPECT_TRUE(nlohmann::json::parse(read_whole(folder / "graph.json")).at("nodes").empty());
  EXPECT_TRUE(is_well_formed(read_whole(folder / "graph.graphml")));
}

TEST(GraphExport, UnknownExtensionsAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_graph({}, folder / "graph.gml"), InputError);
  EXPECT_THROW(write_graph({}, folder / "none/graph.json"), InputError);
  EXPECT_TRUE(folder.is_empty());
}

}  // namespace
}  // namespace ridgeway
