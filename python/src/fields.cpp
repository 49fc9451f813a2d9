// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// What the config structs are in Python. Lengths in metres, angles in radians.
#include "config.hpp"

namespace ridgeway::python {
namespace {

/// The fields that a BuildConfig has, alone or as part of another struct.
template <typename Config, typename Add>
void add_build_fields(const Add& add) {
  add("min_clearance", &BuildConfig::min_clearance,
      "smallest robot radius the roadmap is for, metres");
  add("unknown", &BuildConfig::unknown,
      "what unknown space is: 'obstacle', 'ignore' (kept out of, no distance to it) or 'free'");
  add("max_distance", &BuildConfig::max_distance, "distances stop here, metres");
  add("limits", &BuildConfig::limits, "FlightLimits of every flight, or None");
  add("theta", &BuildConfig::theta, "least angle between the directions to two obstacles, radians");
  add("least_apart", &BuildConfig::least_apart, "least distance between two obstacles, metres");
  add("prune_radius", &BuildConfig::prune_radius,
      "vertices nearer than this, or two voxels, become one, metres");
  add("split_deviation", &BuildConfig::split_deviation,
      "greatest distance of an edge from its diagram, metres; 0: two voxels");
  add("significance", &BuildConfig::significance, "dead ends that reach less far go, metres");
  add("simplify", &BuildConfig::simplify, "leave out what noise and voxels put into the graph");
  add("tangent_pairs", &BuildConfig::tangent_pairs,
      "of places, at most, to learn shortcuts around corners from; 0: none");
  add("basis_point_edges", &BuildConfig::basis_point_edges,
      "edges of the diagram by basis points, not by their neighbours");
  add("paper_diagram", &BuildConfig::paper_diagram, "thinned edges alone, for comparison");
}

template <typename Config, typename Add>
void add_fusion_fields(const Add& add) {
  add("voxel_size", &FusionConfig::voxel_size, "metres");
  add("truncation", &FusionConfig::truncation,
      "distances are kept up to here, metres; 0: four voxels");
  add("depth_behind", &FusionConfig::depth_behind,
      "behind a surface space is solid so far, metres; 0: two voxels");
  add("min_range", &FusionConfig::min_range, "nearer measurements are passed over, metres");
  add("max_range", &FusionConfig::max_range,
      "what is farther only frees the way up to here, metres");
  add("carve", &FusionConfig::carve, "what lies before a surface becomes free");
  add("max_weight", &FusionConfig::max_weight, "a voxel never knows better: the old fades");
  add("forget_after", &FusionConfig::forget_after,
      "looks in a row after which what was moved is forgotten; 0: never");
  add("clear_radius", &FusionConfig::clear_radius,
      "around every pose what was not measured is free, metres");
  add("integrator", &FusionConfig::integrator, "of images: 'projective' or 'ray_casting'");
}

}  // namespace

const Fields<LoadConfig>& load_fields() {
  static const Fields<LoadConfig> fields =
      Fields<LoadConfig>()
          .add("voxel_size", &LoadConfig::voxel_size,
               "metres; required for point clouds, otherwise not finer than the map's own")
          .add("bounds", &LoadConfig::bounds,
               "flight volume ((x0, y0, z0), (x1, y1, z1)), metres; required for point clouds")
          .add("exclude", &LoadConfig::exclude, "no-fly boxes, made occupied")
          .add("transform", &LoadConfig::transform,
               "(4, 4) from the file's frame to the world's (z up), or None")
          .add("units", &LoadConfig::units, "of meshes: metres a unit; None: the file's")
          .add("up", &LoadConfig::up,
               "of meshes: which axis points up, 'x', 'y', 'z'; None: the file's")
          .add("inside", &LoadConfig::inside,
               "of meshes: places in open space (N, 3), metres; what is reached from them is free")
          .add("isolated_below", &LoadConfig::isolated_below,
               "clusters of fewer occupied voxels become free");
  return fields;
}

const Fields<EsdfConfig>& esdf_fields() {
  static const Fields<EsdfConfig> fields =
      Fields<EsdfConfig>()
          .add("unknown", &EsdfConfig::unknown,
               "what unknown space is: 'obstacle', 'ignore' or 'free'")
          .add("max_distance", &EsdfConfig::max_distance, "distances stop here, metres")
          .add("limits", &EsdfConfig::limits, "FlightLimits of every flight, or None");
  return fields;
}

const Fields<GvdConfig>& gvd_fields() {
  static const Fields<GvdConfig> fields =
      Fields<GvdConfig>()
          .add("theta", &GvdConfig::theta,
               "least angle between the directions to two obstacles, radians")
          .add("least_apart", &GvdConfig::least_apart,
               "least distance between two obstacles, metres");
  return fields;
}

const Fields<GraphConfig>& graph_fields() {
  static const Fields<GraphConfig> fields =
      Fields<GraphConfig>()
          .add("min_clearance", &GraphConfig::min_clearance, "of every edge, metres")
          .add("prune_radius", &GraphConfig::prune_radius,
               "vertices nearer than this, or two voxels, become one, metres")
          .add("split_deviation", &GraphConfig::split_deviation,
               "greatest distance of an edge from its diagram, metres; 0: two voxels")
          .add("widest_kept", &GraphConfig::widest_kept,
               "up to this clearance edges are as wide as their curves, metres; 0: three times "
               "min_clearance");
  return fields;
}

const Fields<SimplifyConfig>& simplify_fields() {
  static const Fields<SimplifyConfig> fields =
      Fields<SimplifyConfig>()
          .add("significance", &SimplifyConfig::significance,
               "dead ends that reach less far go, metres")
          .add("steepness", &SimplifyConfig::steepness,
               "and those that reach less far than this share of their length")
          .add(
              "widest_kept", &SimplifyConfig::widest_kept,
              "up to this clearance ways stay as wide as they were, metres; 0: twice min_clearance")
          .add("width_step", &SimplifyConfig::width_step, "in steps of this share of min_clearance")
          .add("stretch", &SimplifyConfig::stretch, "but may become longer by this factor");
  return fields;
}

const Fields<BuildConfig>& build_fields() {
  static const Fields<BuildConfig> fields = [] {
    Fields<BuildConfig> all;
    add_build_fields<BuildConfig>(
        [&](const char* name, auto member, const char* doc) { all.add(name, member, doc); });
    return all;
  }();
  return fields;
}

const Fields<PlanConfig>& plan_fields() {
  static const Fields<PlanConfig> fields =
      Fields<PlanConfig>()
          .add("radius", &PlanConfig::radius, "of the robot, metres; None: the roadmap's")
          .add("planner", &PlanConfig::planner, "'graph', 'diagram', 'esdf' (A*) or 'theta'")
          .add("shorten", &PlanConfig::shorten, "pull the path tight")
          .add("quick", &PlanConfig::quick,
               "settle for the first path that is not clearly too long, but may be a detour")
          .add("within", &PlanConfig::within,
               "go on until at most so many times the shortest; 0: as long as that pays")
          .add("time_limit", &PlanConfig::time_limit, "seconds")
          .add("prefer_clearance", &PlanConfig::prefer_clearance,
               "what distance from walls is worth: 0 nothing, 1 some, 10 the middle")
          .add("escape", &PlanConfig::escape, "start and goal may be too close to an obstacle")
          .add("limits", &PlanConfig::limits, "FlightLimits of this flight, or None")
          .add("snap", &PlanConfig::snap,
               "start and goal that cannot be used are moved up to so far, metres")
          .add("robot_height", &PlanConfig::robot_height,
               "above 0: an upright cylinder of this height, metres");
  return fields;
}

const Fields<CheckConfig>& check_fields() {
  static const Fields<CheckConfig> fields =
      Fields<CheckConfig>()
          .add("limits", &CheckConfig::limits, "FlightLimits of all flights, or None")
          .add("robot_height", &CheckConfig::robot_height, "as in plan(), metres")
          .add("quick", &CheckConfig::quick, "as in plan(), of the roadmap's answers")
          .add("within", &CheckConfig::within, "as in plan(), of the roadmap's answers");
  return fields;
}

const Fields<TrajectoryConfig>& trajectory_fields() {
  using Config = TrajectoryConfig;
  static const Fields<Config> fields =
      Fields<Config>()
          .add(&Config::motion, "max_speed", &MotionLimits::max_speed, "metres a second")
          .add(&Config::motion, "max_acceleration", &MotionLimits::max_acceleration,
               "metres a second^2")
          .add(&Config::motion, "max_jerk", &MotionLimits::max_jerk, "metres a second^3")
          .add(&Config::motion, "max_yaw_rate", &MotionLimits::max_yaw_rate, "radians a second")
          .add("smoothness", &Config::smoothness, "what is least: 'snap' or 'jerk'")
          .add("start_velocity", &Config::start_velocity, "(x, y, z), metres a second")
          .add("start_acceleration", &Config::start_acceleration, "(x, y, z), metres a second^2")
          .add("start_yaw", &Config::start_yaw, "radians; None: the direction of travel")
          .add("follow_yaw", &Config::follow_yaw, "yaw follows the direction of travel")
          .add("limits", &Config::limits, "FlightLimits, or None")
          .add("robot_height", &Config::robot_height, "as in plan(), metres")
          .add("stop_and_go", &Config::stop_and_go, "straight from corner to corner")
          .add("via", &Config::via,
               "points of the path that are passed as they are (N, 3), metres; other corners are "
               "rounded")
          .add("most_evaluations", &Config::most_evaluations,
               "of the cost, each time that a stretch is optimised");
  return fields;
}

const Fields<FusionConfig>& fusion_fields() {
  static const Fields<FusionConfig> fields = [] {
    Fields<FusionConfig> all;
    add_fusion_fields<FusionConfig>(
        [&](const char* name, auto member, const char* doc) { all.add(name, member, doc); });
    all.add("origin", &FusionConfig::origin,
            "voxel of the lattice that is the map's own (0, 0, 0); None: the sensor's at first");
    return all;
  }();
  return fields;
}

const Fields<LiveConfig>& live_fields() {
  static const Fields<LiveConfig> fields = [] {
    Fields<LiveConfig> all;
    add_fusion_fields<LiveConfig>([&](const char* name, auto member, const char* doc) {
      all.add(&LiveConfig::fusion, name, member, doc);
    });
    add_build_fields<LiveConfig>([&](const char* name, auto member, const char* doc) {
      all.add(&LiveConfig::build, name, member, doc);
    });
    all.add("origin", &LiveConfig::origin,
            "voxel of the lattice that is the map's own (0, 0, 0); None: the sensor's at first")
        .add("window", &LiveConfig::window, "blocks farther than this from the sensor wait, metres")
        .add("log_folder", &LiveConfig::log_folder,
             "new or empty, keeps scans for correct_poses; '': none are")
        .add("log_bytes", &LiveConfig::log_bytes, "of all scans that are kept");
    return all;
  }();
  return fields;
}

const Fields<ExplorerConfig>& explorer_fields() {
  using Config = ExplorerConfig;
  static const Fields<Config> fields =
      Fields<Config>()
          .add(&Config::motion, "max_speed", &MotionLimits::max_speed, "metres a second")
          .add(&Config::motion, "max_acceleration", &MotionLimits::max_acceleration,
               "metres a second^2")
          .add(&Config::motion, "max_jerk", &MotionLimits::max_jerk, "metres a second^3")
          .add(&Config::motion, "max_yaw_rate", &MotionLimits::max_yaw_rate, "radians a second")
          .add(&Config::view, "horizontal", &FieldOfView::horizontal,
               "angle that the sensor sees, radians; a whole turn: all around")
          .add(&Config::view, "vertical", &FieldOfView::vertical,
               "angle that it sees, in the middle, radians")
          .add(&Config::view, "nearest", &FieldOfView::nearest,
               "what is nearer is not seen, metres")
          .add(&Config::view, "range", &FieldOfView::range,
               "what is farther is not counted on, metres")
          .add("within", &Config::within,
               "first and last voxel of the lattice to explore, (2, 3); None: all")
          .add("least_frontier", &Config::least_frontier,
               "voxels of a frontier that is worth a look")
          .add("spacing", &Config::spacing, "between viewpoints, about, metres")
          .add("headings", &Config::headings, "directions that are tried at each")
          .add("strategy", &Config::strategy, "'tour' or 'nearest'")
          .add("persistence", &Config::persistence,
               "seconds by which another tour must be shorter for the goal to be given up")
          .add("resolved_below", &Config::resolved_below,
               "the goal is given up once less than this share of it is left to see")
          .add("most_rays", &Config::most_rays, "cast in one decision")
          .add("most_stops", &Config::most_stops, "of a tour")
          .add("kept_clearance", &Config::kept_clearance,
               "that the rest of a trajectory must keep, metres; 0: the roadmap's min_clearance")
          .add("most_looks", &Config::most_looks,
               "in vain, after which an unknown voxel is left alone")
          .add("home", &Config::home, "where to be at the end, (x, y, z), metres; None: anywhere")
          .add("until", &Config::until, "time until which to be home, seconds; needs home")
          .add("period", &Config::period, "seconds between decisions, where they count for until");
  return fields;
}

const Fields<PictureConfig>& picture_fields() {
  using Config = PictureConfig;
  static const Fields<Config> fields =
      Fields<Config>()
          .add("width", &Config::width, "pixels, 400 to 16000")
          .add("band", &Config::band,
               "heights (low, high) that count for walls and free space, metres; None: the middle")
          .add("floors", &Config::floors, "a plan for each storey, in place of one")
          .add("sides", &Config::sides, "the map from the front and from a side too")
          .add("section_y", &Config::section_y, "a section at this y, metres, or None")
          .add("section_x", &Config::section_x, "a section at this x, metres, or None")
          .add("diagram", &Config::diagram, "draw the skeleton")
          .add("graph", &Config::graph, "draw the graph")
          .add("narrow_places", &Config::narrow_places,
               "rings where components would be one for a smaller robot")
          .add("diagram_colour", &Config::diagram_colour,
               "what it says: 'clearance', 'height' or 'component'")
          .add("title", &Config::title, "'': the name of the map's file");
  return fields;
}

}  // namespace ridgeway::python
