// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_basins.hpp"

#include <utility>

namespace ridgeway::detail {

void update_basins(LiveBasins& basins, const LiveField& field, const LiveRidges& ridges) {
  basins.ways.grow(field.esdf.layout);
  look_at_blocks(field.esdf, ridges.traversable, blocks_around(field.esdf.layout, field.changed),
                 basins.ways);
}

Watershed watershed_of(const LiveBasins& basins, const LiveField& field, const LiveRidges& ridges) {
  Basins local;
  local.next = basins.ways.next;
  local.not_simple_at_first_turn = basins.ways.not_simple_at_first_turn;
  return watershed_of(field.esdf, ridges.traversable, basins.ways.blocks, std::move(local));
}

}  // namespace ridgeway::detail
