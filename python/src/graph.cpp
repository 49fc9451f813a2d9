// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Sparse graphs as arrays.
#include "config.hpp"
#include "faces.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway::python {
namespace {

/// One member of every element of a vector, (N,), in the vector's own memory.
template <typename Element, typename Value>
py::array column(const std::vector<Element>& elements, Value Element::*member, py::handle owner) {
  if (elements.empty()) return py::array_t<Value>(0);
  return view_of(&(elements.front().*member), {static_cast<py::ssize_t>(elements.size())},
                 {sizeof(Element)}, owner);
}

py::array vertices(const GraphFace& face) {
  std::vector<Point> positions;
  positions.reserve(face.graph->vertices.size());
  for (const Vertex& vertex : face.graph->vertices)
    positions.push_back(to_world(*face.esdf, vertex.position));
  return array_of(std::move(positions));
}

py::array edges(const py::object& self) {
  const auto& all = self.cast<const GraphFace&>().graph->edges;
  static_assert(offsetof(Edge, to) == offsetof(Edge, from) + sizeof(std::uint32_t));
  if (all.empty()) return py::array_t<std::uint32_t>(std::vector<py::ssize_t>{0, 2});
  return view_of(reinterpret_cast<const std::uint32_t*>(&all.front().from),
                 {static_cast<py::ssize_t>(all.size()), 2}, {sizeof(Edge), sizeof(std::uint32_t)},
                 self);
}

py::array components(const GraphFace& face) {
  std::vector<std::uint32_t> labels = connected_components(*face.graph).label;
  const auto count = static_cast<py::ssize_t>(labels.size());
  return owning_array(std::move(labels), {count});
}

py::object to_networkx(const GraphFace& face) {
  const py::module_ networkx = py::module_::import("networkx");
  py::object graph = networkx.attr("Graph")(py::arg("min_clearance") = face.graph->min_clearance);
  py::list nodes, links;
  for (std::size_t i = 0; i < face.graph->vertices.size(); ++i) {
    const Vertex& vertex = face.graph->vertices[i];
    py::dict facts;
    facts["pos"] = tuple_of(to_world(*face.esdf, vertex.position));
    facts["clearance"] = vertex.clearance;
    nodes.append(py::make_tuple(i, facts));
  }
  for (const Edge& edge : face.graph->edges) {
    py::dict facts;
    facts["length"] = edge.length;
    facts["clearance"] = edge.clearance;
    links.append(py::make_tuple(number(edge.from), number(edge.to), facts));
  }
  graph.attr("add_nodes_from")(nodes);
  graph.attr("add_edges_from")(links);
  return graph;
}

std::string graph_repr(const GraphFace& face) {
  return "SparseGraph(vertices=" + std::to_string(face.graph->vertices.size()) +
         ", edges=" + std::to_string(face.graph->edges.size()) +
         ", components=" + std::to_string(connected_components(*face.graph).count) +
         ", min_clearance=" + literal(face.graph->min_clearance) + ")";
}

}  // namespace

void add_graph(py::module_& module) {
  py::class_<GraphFace>(module, "SparseGraph",
                        "Vertices and straight edges along each of which a robot can move.")
      .def_property_readonly("vertices", &vertices, "Positions, (N, 3), metres, world.")
      .def_property_readonly("edges", &edges, "Vertices of each edge, (M, 2) uint32.")
      .def_property_readonly(
          "vertex_clearances",
          [](const py::object& self) {
            return column(self.cast<const GraphFace&>().graph->vertices, &Vertex::clearance, self);
          },
          "Distance of each vertex to the nearest obstacle, (N,), metres.")
      .def_property_readonly(
          "edge_lengths",
          [](const py::object& self) {
            return column(self.cast<const GraphFace&>().graph->edges, &Edge::length, self);
          },
          "(M,), metres.")
      .def_property_readonly(
          "edge_clearances",
          [](const py::object& self) {
            return column(self.cast<const GraphFace&>().graph->edges, &Edge::clearance, self);
          },
          "Smallest distance to an obstacle along each edge, (M,), metres.")
      .def_property_readonly("components", &components,
                             "The connected part that each vertex is in, (N,) uint32.")
      .def_property_readonly(
          "min_clearance", [](const GraphFace& face) { return face.graph->min_clearance; },
          "Of every edge, metres.")
      .def("to_networkx", &to_networkx,
           "to_networkx(self)\n--\n\n"
           "As networkx.Graph: nodes with `pos` and `clearance`, edges with `length` and "
           "`clearance`, metres.")
      .def("__repr__", &graph_repr);
}

}  // namespace ridgeway::python
