// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "common/number_text.hpp"
#include "common/require.hpp"
#include "files/atomic_file.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"

namespace ridgeway {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kDegree = std::numbers::pi / 180.0;

// The ellipsoid of WGS 84.
constexpr double kEquator = 6378137.0;  // radius, metres
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

/// Radius of curvature across the meridian.
double normal_radius(double sin_latitude) {
  return kEquator / std::sqrt(1.0 - kEccentricity2 * sin_latitude * sin_latitude);
}

/// Metres from the Earth's centre; angles in radians.
Point earth_centred(double latitude, double longitude, double altitude) {
  const double radius = normal_radius(std::sin(latitude));
  const double from_axis = (radius + altitude) * std::cos(latitude);
  return {from_axis * std::cos(longitude), from_axis * std::sin(longitude),
          (radius * (1.0 - kEccentricity2) + altitude) * std::sin(latitude)};
}

/// The other way. The latitude is the one at which the vertical through the point meets the axis
/// where it should; each round takes the error down by the eccentricity squared (1/150).
GeoPoint geodetic_of(const Point& p) {
  constexpr int kRounds = 8;
  const double from_axis = std::hypot(p.x(), p.y());
  double latitude = std::atan2(p.z(), from_axis * (1.0 - kEccentricity2));
  for (int i = 0; i < kRounds; ++i) {
    const double sine = std::sin(latitude);
    latitude = std::atan2(p.z() + kEccentricity2 * normal_radius(sine) * sine, from_axis);
  }
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  const double altitude =
      from_axis * cosine + p.z() * sine - kEquator * kEquator / normal_radius(sine);
  return {latitude / kDegree, std::atan2(p.y(), p.x()) / kDegree, altitude};
}

/// Seconds at every corner: the autopilot stops there instead of cutting corners, and what was
/// verified are the legs between them.
constexpr double kHold = 1.0;

/// How near to a corner counts as there, metres: no farther than there is room beside the path.
double acceptance_of(const PlanResult& path) {
  constexpr double kLeast = 0.05, kMost = 0.2;  // below, no satellite navigation gets there
  return std::clamp(path.clearance - path.planned_for.radius, kLeast, kMost);
}

/// Metres from the datum to a place of a mission. A path that is farther away is given in the
/// coordinates of a grid; its altitude would be kilometres off.
constexpr double kFarthest = 2e5;

// Of MAVLink and QGroundControl.
constexpr int kNavWaypoint = 16, kGlobalFrame = 0, kAboveSeaLevel = 2, kPx4 = 12, kQuadrotor = 2;

Json waypoint_item(const GeoPoint& place, double acceptance, std::size_t number) {
  return {
      {"AMSLAltAboveTerrain", nullptr},
      {"Altitude", place.altitude},
      {"AltitudeMode", kAboveSeaLevel},
      {"autoContinue", true},
      {"command", kNavWaypoint},
      {"doJumpId", number},
      {"frame", kGlobalFrame},
      {"params", {kHold, acceptance, 0, nullptr, place.latitude, place.longitude, place.altitude}},
      {"type", "SimpleItem"}};
}

}  // namespace

void Datum::validate() const {
  constexpr double kHighest = 1e5;
  detail::require(std::abs(latitude) <= 90.0, "latitude", latitude, "give -90 to 90 degrees");
  detail::require(std::abs(longitude) <= 180.0, "longitude", longitude, "give -180 to 180 degrees");
  detail::require(std::abs(altitude) <= kHighest, "altitude", altitude,
                  "give metres above mean sea level");
  detail::require(std::abs(x_heading) <= 360.0, "x_heading", x_heading,
                  "give -360 to 360 degrees, clockwise from north");
}

GeoPoint geodetic(const Point& p, const Datum& datum) {
  datum.validate();
  if (!(p.norm() <= kFarthest))
    throw InputError(
        "datum", "is " + number_text(std::round(1e-3 * p.norm())) + " km from where the path leads",
        "give the place of the map's 0,0,0; the numbers of a grid such as UTM are not "
        "metres from a place: build the map near an origin of its own");
  const double latitude = datum.latitude * kDegree, longitude = datum.longitude * kDegree;
  const double heading = datum.x_heading * kDegree;
  // The world's y axis points a quarter turn to the left of its x axis.
  const double east = p.x() * std::sin(heading) - p.y() * std::cos(heading);
  const double north = p.x() * std::cos(heading) + p.y() * std::sin(heading);
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  const Point east_axis(-sin_lon, cos_lon, 0.0),
      up_axis(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
  return geodetic_of(earth_centred(latitude, longitude, datum.altitude) + east * east_axis +
                     north * up_axis.cross(east_axis) + p.z() * up_axis);
}

std::string mission_json(const PlanResult& path, const Datum& datum) {
  datum.validate();
  Json items = Json::array();
  for (const Point& p : path.waypoints)
    items.push_back(waypoint_item(geodetic(p, datum), acceptance_of(path), items.size() + 1));
  const GeoPoint home =
      geodetic(path.waypoints.empty() ? Point::Zero().eval() : path.waypoints.front(), datum);
  const Json json = {
      {"fileType", "Plan"},
      {"version", 1},
      {"groundStation", "QGroundControl"},
      {"mission",
       {{"version", 2},
        {"firmwareType", kPx4},
        {"vehicleType", kQuadrotor},
        {"cruiseSpeed", 15},
        {"hoverSpeed", 5},
        {"globalPlanAltitudeMode", kAboveSeaLevel},
        {"plannedHomePosition", {home.latitude, home.longitude, home.altitude}},
        {"items", std::move(items)}}},
      {"geoFence", {{"version", 2}, {"circles", Json::array()}, {"polygons", Json::array()}}},
      {"rallyPoints", {{"version", 2}, {"points", Json::array()}}}};
  return json.dump(2);
}

void write_mission(const PlanResult& path, const Datum& datum, const std::filesystem::path& file) {
  if (extension_of(file) != ".plan")
    throw InputError(file.string(), "names no mission", "use .plan");
  datum.validate();
  if (path.waypoints.empty())
    throw InputError("path", "has no waypoints: " + std::string(name_of(path.status)),
                     "give a plan that is ok: a mission needs a place to fly to");
  write_text_file(file, mission_json(path, datum) + "\n");
}

}  // namespace ridgeway
