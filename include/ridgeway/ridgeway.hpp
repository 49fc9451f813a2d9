// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

/// Every public header, but for that which needs those of OMPL (ridgeway/sampling/ompl.hpp).
/// Programs link ridgeway::ridgeway for the modules that follow, and for each of the others the
/// component of its name; headers of components that are not installed are passed over.

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/distance_field.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/live/graph_delta.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"
#include "ridgeway/roadmap/tangent_graph.hpp"
#include "ridgeway/sensing/depth_camera.hpp"
#include "ridgeway/sensing/solid_mesh.hpp"
#include "ridgeway/sensing/world.hpp"
#include "ridgeway/skeleton/basins.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "ridgeway/version.hpp"
#include "ridgeway/voxel/block_layout.hpp"
#include "ridgeway/voxel/index.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"
#include "ridgeway/voxel/voxel_field.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

#if __has_include("ridgeway/sampling/plan_by_sampling.hpp")
#include "ridgeway/sampling/plan_by_sampling.hpp"
#endif
#if __has_include("ridgeway/exploration/explorer.hpp")
#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/exploration/frontiers.hpp"
#endif
#if __has_include("ridgeway/trajectory/plan_trajectory.hpp")
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "ridgeway/trajectory/trajectory.hpp"
#endif
#if __has_include("ridgeway/ridge/ridge_file.hpp")
#include "ridgeway/ridge/ridge_file.hpp"
#endif
#if __has_include("ridgeway/pictures/picture.hpp")
#include "ridgeway/pictures/picture.hpp"
#endif
#if __has_include("ridgeway/formats/graph_export.hpp")
#include "ridgeway/formats/graph_export.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/formats/world_file.hpp"
#endif
#if __has_include("ridgeway/recordings/depth_sequence.hpp")
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#endif
