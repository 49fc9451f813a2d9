// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "files/text.hpp"
#include "flight_picture.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "limit_options.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "roadmap_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kDegree = std::numbers::pi / 180.0;

struct TrajectoryOptions {
  std::string file, derivative = "snap", output, picture;
  std::string path;
  std::optional<Point> from, to, from_velocity;
  std::vector<Point> via;
  std::optional<double> radius, max_jerk, yaw;
  double max_speed = 2.0, max_acceleration = 2.0, max_yaw_rate = 90.0, step = 0.01;
  double prefer_clearance = 0.0, snap = 0.0, robot_height = 0.0;
  bool stop_and_go = false, escape = false;
  LimitOptions limits;
};

TrajectoryConfig trajectory_config(const TrajectoryOptions& options, double radius) {
  TrajectoryConfig config;
  config.radius = radius;
  config.motion.max_speed = options.max_speed;
  config.motion.max_acceleration = options.max_acceleration;
  if (options.max_jerk) config.motion.max_jerk = *options.max_jerk;
  config.motion.max_yaw_rate = options.max_yaw_rate * kDegree;
  if (options.derivative == "jerk") config.smoothness = Smoothness::kJerk;
  if (options.from_velocity) config.start_velocity = *options.from_velocity;
  if (options.yaw) config.start_yaw = *options.yaw * kDegree;
  config.follow_yaw = !options.yaw;
  config.limits = limits_of(options.limits);
  config.robot_height = options.robot_height;
  config.stop_and_go = options.stop_and_go;
  config.via = options.via;
  config.validate();
  return config;
}

/// Of the first leg that is not free.
std::string explain_not_free(const EsdfMap& esdf, const std::vector<Point>& path,
                             const TrajectoryConfig& config) {
  const FlightLimits limits = both_of(esdf.limits, limits_in_local(esdf, config.limits));
  const FreeSpace space(esdf, limits, config.radius, config.robot_height);
  for (std::size_t i = path.size() > 1 ? 1 : 0; i < path.size(); ++i) {
    const Point &from = path[i == 0 ? 0 : i - 1], &to = path[i];
    const Point a = flight_place(esdf, from), b = flight_place(esdf, to);
    if (space.is_free(a, b, config.radius)) continue;
    const std::string leg =
        "the path is not free between " + point_text(from) + " and " + point_text(to) + ": ";
    if (!space.is_within_limits(a, b))
      return leg + "it leaves the limits of the flight: give wider ones, or another path";
    const double clearance = space.clearance(a, b);
    if (clearance >= config.radius)
      return leg + "the robot does not fit, or space is unknown there: plan the path on this map";
    const bool may_be_escape = i <= 1 || i + 1 == path.size();
    return leg + "it comes within " + text_of(rounded_down(clearance)) +
           " m of an obstacle, and the robot's radius is " + text_of(config.radius) +
           " m: give a smaller --radius, or plan the path on this map" +
           (may_be_escape ? "; where it is an escape, give what `plan --escape` wrote as .json"
                          : "");
  }
  return "the path is not free at the radius";
}

std::string explain_no_trajectory(const EsdfMap& esdf, const std::vector<Point>& path,
                                  const TrajectoryConfig& config, const TrajectoryResult& result) {
  if (result.status == TrajectoryStatus::kCannotStopInTime)
    return "the robot can neither follow the path from its motion nor brake in free space: give a "
           "lower --from-velocity or a higher --max-acceleration";
  return explain_not_free(esdf, path, config);
}

void print_result(const PlanResult& path, const TrajectoryResult& flown, double radius) {
  print_row("path", text_of(path.length) + " m, " + count_text(path.waypoints.size()) +
                        " waypoints, " + seconds_text(path.seconds.total));
  print_row("trajectory", text_of(flown.duration) + " s, " + std::string(name_of(flown.step)) +
                              "; stop and go " + text_of(flown.stop_and_go_duration) + " s");
  for (const auto& [end, moved] :
       {std::pair("start", path.moved_start), std::pair("goal", path.moved_goal)})
    if (moved.distance > 0.0)
      print_row("moved", std::string("the ") + end + " by " + text_of(moved.distance) + " m, to " +
                             point_text(moved.place));
  print_row("at most", text_of(rounded_up(flown.peaks.speed)) + " m/s, " +
                           text_of(rounded_up(flown.peaks.acceleration)) + " m/s^2, yaw " +
                           text_of(rounded_up(flown.peaks.yaw_rate / kDegree)) + " degrees/s");
  print_row("clearance",
            text_of(rounded_down(flown.clearance)) + " m, robot radius " + text_of(radius) + " m");
  print_row("time", seconds_text(flown.seconds.total) + " (optimise " +
                        seconds_text(flown.seconds.optimise) + ", verify " +
                        seconds_text(flown.seconds.verify) + ")");
}

/// Exit code 2, with the reason, for a path or a trajectory that there is not.
int report_none(const TrajectoryOptions& options, const std::string& status,
                const std::string& reason, Json json, const Globals& globals) {
  for (const std::string& file : {options.output, options.picture})
    warn_of_unwritten(globals, file);
  json["status"] = status;
  json["reason"] = reason;
  if (globals.json) {
    print_json(json);
  } else {
    print_row("no trajectory", status);
    print_row("reason", reason);
  }
  return kExitNoPlan;
}

PlanConfig plan_config(const TrajectoryOptions& options, double radius) {
  PlanConfig config{.radius = radius,
                    .prefer_clearance = options.prefer_clearance,
                    .escape = options.escape,
                    .limits = limits_of(options.limits),
                    .snap = options.snap,
                    .robot_height = options.robot_height};
  config.validate();
  return config;
}

/// What to fly along, or the query that has no path.
struct Course {
  PlanResult path;
  Query query;
  OnTheWay on_the_way;
  std::string leg;  // which part of the course the query is
};

Course find_course(const TrajectoryOptions& options, const Roadmap& roadmap, double radius) {
  if (!options.path.empty()) {
    Course course{given_path(roadmap, read_path(options.path), options.path), {}, {}, {}};
    const PathEscapes escapes = read_escapes(options.path);
    course.path.escape_start = escapes.start;
    course.path.escape_goal = escapes.goal;
    course.query = {course.path.waypoints.front(), course.path.waypoints.back(), radius};
    return course;
  }
  std::vector<Point> places{*options.from};
  places.insert(places.end(), options.via.begin(), options.via.end());
  places.push_back(*options.to);
  ViaPlan via = plan_via(roadmap, places, plan_config(options, radius));
  Course course{std::move(via.plan),
                {places[via.leg], places[via.leg + 1], radius},
                {via.leg > 0, via.leg + 2 < places.size()},
                {}};
  if (!options.via.empty())
    course.leg = "on leg " + count_text(via.leg + 1) + " of " + count_text(places.size() - 1) +
                 ", from " + point_text(course.query.start) + " to " +
                 point_text(course.query.goal) + ": ";
  return course;
}

void require_one_course(const TrajectoryOptions& options) {
  const bool of_file = !options.path.empty();
  if (of_file ? options.from || options.to : !options.from || !options.to)
    throw InputError("trajectory", "needs a start and a goal, or a path",
                     "give --from X,Y,Z and --to X,Y,Z, or --path FILE alone");
  if (of_file && (!options.via.empty() || options.escape || options.snap != 0.0 ||
                  options.prefer_clearance != 0.0))
    throw InputError("--path", "is flown as it is",
                     "leave out --via, --escape, --snap and --prefer-clearance");
}

int run(const TrajectoryOptions& options, const Globals& globals) {
  require_one_course(options);
  trajectory_config(options, options.radius.value_or(1.0));  // bad limits, before the file is read
  plan_config(options, options.radius.value_or(1.0));
  std::vector<std::filesystem::path> written, read{options.file};
  if (!options.path.empty()) read.emplace_back(options.path);
  if (!options.output.empty()) {
    if (extension_of(options.output) == ".plan")
      throw InputError(options.output, "is a mission, whose legs are straight",
                       "write the path as one with `ridgeway plan`");
    require_trajectory_format(options.output);
    written.emplace_back(options.output);
  }
  if (!options.picture.empty()) written.emplace_back(options.picture);
  require_writable(written, read);
  if (!options.picture.empty()) require_extension(options.picture, "a picture", {".png", ".svg"});

  const Roadmap roadmap = load_roadmap(options.file);
  const double radius = options.radius.value_or(roadmap.min_clearance);
  const TrajectoryConfig config = trajectory_config(options, radius);
  const Course course = find_course(options, roadmap, radius);
  const PlanResult& path = course.path;
  if (!path.ok())
    return report_none(
        options, std::string(name_of(path.status)),
        course.leg + AnswerFacts(roadmap, plan_config(options, radius))
                         .reason(as_planned(course.query, path), path.status, course.on_the_way),
        Json::parse(plan_json(path)), globals);
  const TrajectoryResult flown = fly_plan(roadmap.esdf, path, config);
  if (!flown.ok())
    return report_none(options, std::string(name_of(flown.status)),
                       explain_no_trajectory(roadmap.esdf, path.waypoints, config, flown),
                       Json::parse(trajectory_json(path, flown, options.step)), globals);

  stop_if_interrupted();
  constexpr double kMostSamples = 1e6;
  const std::string extension = extension_of(options.output);
  const bool is_sampled = globals.json || extension == ".csv" || extension == ".json";
  if (is_sampled && !(flown.duration / options.step <= kMostSamples))
    throw InputError("--step " + text_of(options.step, 6),
                     "gives more than a million samples of " + text_of(flown.duration) + " s",
                     "give a larger one");
  if (!options.output.empty()) write_trajectory(path, flown, options.output, options.step);
  if (!options.picture.empty())
    draw_flight(roadmap, path.waypoints, flown, config, options.picture);
  if (globals.json)
    print_json(Json::parse(trajectory_json(path, flown, options.step)));
  else
    print_result(path, flown, radius);
  for (const auto& file : written)
    if (!globals.json) print_row("written to", file.string());
  return kExitDone;
}

}  // namespace

void add_trajectory_command(Command& program) {
  const auto options = std::make_shared<TrajectoryOptions>();
  Command command =
      program.add("trajectory", "Plan a path, and a verified trajectory to fly along it");
  command.path("roadmap", options->file, "Roadmap, .ridge").required();
  command.point("--from", options->from, "Start X,Y,Z, metres");
  command.point("--to", options->to, "Goal X,Y,Z, metres");
  command.points("--via", options->via,
                 "Place X,Y,Z on the way, metres, as it is (--snap and --escape are of start and "
                 "goal); may be repeated");
  command.path("--path", options->path,
               "Path to fly in place of one from a start to a goal, .json or .csv of plan");
  command.flag("--escape", options->escape,
               "Start and goal may be too close to an obstacle: leave it the short way first");
  command.number("--snap", options->snap, kLengthsFromZero,
                 "Start and goal that cannot be used are moved to the nearest place that can, by "
                 "so many metres at most");
  command.number("--prefer-clearance", options->prefer_clearance, {0.0, 1e6},
                 "What distance d from walls is worth: a metre costs 1 + it * (radius / d)^2");
  command.number("--robot-height", options->robot_height, kLengthsFromZero,
                 "Metres: the robot is an upright cylinder of this height and the radius; 0: it is "
                 "a sphere");
  command.number("--radius", options->radius, kLengths,
                 "Robot radius, metres (default: the smallest the roadmap is for)");
  add_limit_options(command, options->limits);
  command.number("--max-speed", options->max_speed, kMotions, "Metres a second");
  command.number("--max-acceleration", options->max_acceleration, kMotions, "Metres a second^2");
  command.number("--max-jerk", options->max_jerk, kMotions,
                 "Metres a second^3 (default: no limit)");
  command.number("--max-yaw-rate", options->max_yaw_rate, kMotions, "Degrees a second");
  command.choice("--derivative", options->derivative, {"snap", "jerk"}, "What is smallest");
  command.point("--from-velocity", options->from_velocity,
                "Velocity X,Y,Z at the start, metres a second (default: at rest)");
  command.number("--yaw", options->yaw, kDegrees,
                 "Constant yaw, degrees (default: the direction of travel)");
  command.flag("--stop-and-go", options->stop_and_go,
               "Straight legs from stop to stop; from a motion it brakes first");
  command.number("--step", options->step, {1e-4, 1e4}, "Seconds between samples");
  command.path("-o,--output", options->output,
               "Trajectory to write, .csv, .json, or .yaml of mav_trajectory_generation");
  command.path("--picture", options->picture,
               "Picture of map and trajectory, with speed, acceleration and clearance over time, "
               ".png or .svg");
  command.footer(
      "Exit code 2 when there is none; the reason is in the output.\n"
      "Example:\n"
      "  ridgeway trajectory office.ridge --from 0,0,0.6 --to 10,0,0.6 -o trajectory.yaml");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
