// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>

#include "cell_neighbours.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Finds the nooks and bends of a graph whose cells have places and edges: with them it connects
/// what moves across faces of voxels connect at the smallest radius, however narrow that is.
/// `radius`: the smallest, metres.
void add_bends(const FreeSpace& space, double radius, CellGraph& graph);

/// The cell that a place is in.
inline CellId cell_of_place(const CellGraph& graph, CellId place) {
  return place < graph.cells.size() ? place : graph.nooks[place - graph.cells.size()].cell;
}
/// Its number in that cell.
inline std::uint8_t number_in_cell(const CellGraph& graph, CellId place) {
  return place < graph.cells.size() ? graph.cells[place].place
                                    : graph.nooks[place - graph.cells.size()].place;
}

/// The bends from a place.
std::span<const CellGraph::Bend> bends_from(const CellGraph& graph, CellId place);

/// The nooks of a cell, as places: from the first to before the last.
struct PlaceRange {
  CellId first, last;
};
PlaceRange nooks_of(const CellGraph& graph, CellId cell);

}  // namespace ridgeway::detail
