// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Of the ellipsoid at a latitude, radians: along the meridian and across it.
double meridian_radius(double latitude) {
  return 6335439.3272928 / std::pow(1.0 - 0.00669437999014 * std::pow(std::sin(latitude), 2), 1.5);
}
double normal_radius(double latitude) {
  return 6378137.0 / std::sqrt(1.0 - 0.00669437999014 * std::pow(std::sin(latitude), 2));
}

TEST(Mission, MetresNearTheDatumAreThoseOfTheEllipsoidThere) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Datum datum{random.uniform(-80.0, 80.0), random.uniform(-179.0, 179.0),
                      random.uniform(-100.0, 5000.0)};
    const Point p(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0),
                  random.uniform(-5.0, 50.0));
    const GeoPoint place = geodetic(p, datum);
    const double latitude = datum.latitude * kDegree, up = datum.altitude;
    const double north =
        (place.latitude - datum.latitude) * kDegree * (meridian_radius(latitude) + up);
    const double east = (place.longitude - datum.longitude) * kDegree *
                        (normal_radius(latitude) + up) * std::cos(latitude);
    EXPECT_NEAR(east, p.x(), 1e-3);
    EXPECT_NEAR(north, p.y(), 1e-3);
    EXPECT_NEAR(place.altitude - up, p.z(), 1e-4);
  }
}

TEST(Mission, AKilometreAwayTheEarthHasFallenEightCentimetres) {
  const Datum datum{47.3977, 8.5456, 488.0};
  for (const Point& p : {Point(1000.0, 0.0, 0.0), Point(0.0, -1000.0, 0.0)})
    EXPECT_NEAR(geodetic(p, datum).altitude, 488.0784, 5e-4);
}

TEST(Mission, PlacesOfNoDatumAreRefused) {
  for (const double latitude : {97.0, std::nan("")})
    EXPECT_THROW(geodetic({10.0, 0.0, 0.0}, {.latitude = latitude, .longitude = 8.0}), InputError);
}

TEST(Mission, TheHeadingOfTheXAxisTurnsTheMap) {
  Datum datum{47.0, 8.0, 0.0};
  datum.x_heading = 0.0;  // x is north, y west
  const GeoPoint north = geodetic({100.0, 0.0, 0.0}, datum),
                 west = geodetic({0.0, 100.0, 0.0}, datum);
  EXPECT_NEAR(north.longitude, 8.0, 1e-9);
  EXPECT_NEAR((north.latitude - 47.0) * kDegree * meridian_radius(47.0 * kDegree), 100.0, 1e-2);
  EXPECT_LT(west.longitude, 8.0);
  EXPECT_NEAR(west.latitude, 47.0, 1e-7);
}

TEST(Mission, IsAPlanOfQGroundControlWithAWaypointACorner) {
  PlanResult path;
  path.status = PlanStatus::kOk;
  path.waypoints = {{0.0, 0.0, 10.0}, {3.0, 4.0, 12.0}};
  const Datum datum{47.3977, 8.5456, 488.0};
  const auto json = nlohmann::json::parse(mission_json(path, datum));
  EXPECT_EQ(json.at("fileType"), "Plan");
  EXPECT_EQ(json.at("version"), 1);
  const auto& mission = json.at("mission");
  EXPECT_EQ(mission.at("version"), 2);
  EXPECT_NEAR(mission.at("plannedHomePosition").at(2).get<double>(), 498.0, 1e-6);
  ASSERT_EQ(mission.at("items").size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& item = mission.at("items").at(i);
    const GeoPoint place = geodetic(path.waypoints[i], datum);
    EXPECT_EQ(item.at("type"), "SimpleItem");
    EXPECT_EQ(item.at("command"), 16);
    EXPECT_EQ(item.at("frame"), 0);
    EXPECT_EQ(item.at("doJumpId"), i + 1);
    ASSERT_EQ(item.at("params").size(), 7u);
    EXPECT_GT(item.at("params").at(0).get<double>(), 0.0) << "corners would be cut";
    EXPECT_TRUE(item.at("params").at(3).is_null());
    EXPECT_EQ(item.at("params").at(4).get<double>(), place.latitude);
    EXPECT_EQ(item.at("params").at(5).get<double>(), place.longitude);
    EXPECT_EQ(item.at("params").at(6).get<double>(), place.altitude);
    EXPECT_EQ(item.at("Altitude").get<double>(), place.altitude);
  }
}

TEST(Mission, CornersAreReachedWithinTheRoomBesideThePath) {
  PlanResult path;
  path.waypoints = {{0.0, 0.0, 10.0}};
  path.planned_for.radius = 0.5;
  const auto acceptance = [&](double clearance) {
    path.clearance = clearance;
    const auto json = nlohmann::json::parse(mission_json(path, {}));
    return json.at("mission").at("items").at(0).at("params").at(1).get<double>();
  };
  EXPECT_EQ(acceptance(std::numeric_limits<double>::infinity()), 0.2);
  EXPECT_NEAR(acceptance(0.6), 0.1, 1e-12);
  EXPECT_EQ(acceptance(0.5), 0.05);
}

TEST(Mission, CoordinatesOfAGridAreRefused) {
  const Datum datum{41.99, -93.0, 0.0};
  EXPECT_NEAR(geodetic(Point(1e5, 0.0, 0.0), datum).altitude, 784.0, 5.0);
  geodetic(Point(199e3, 0.0, 0.0), datum);
  EXPECT_NE(refusal([&] { geodetic(Point(201e3, 0.0, 0.0), datum); }).find("201 km"),
            std::string::npos);
  EXPECT_NE(refusal([&] { geodetic(Point(500123.4, 4649777.65, 120.0), datum); }).find("4677 km"),
            std::string::npos);
}

TEST(Mission, ABadDatumOrNameIsRefused) {
  const TemporaryFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<Datum, std::string>> cases = {{{91.0, 0.0, 0.0}, "latitude"},
                                                            {{0.0, 181.0, 0.0}, "longitude"},
                                                            {{nan, 0.0, 0.0}, "latitude"},
                                                            {{0.0, 0.0, nan}, "altitude"},
                                                            {{0.0, 0.0, 0.0, nan}, "x_heading"}};
  for (const auto& bad : cases)
    EXPECT_NE(refusal([&] { write_mission({}, bad.first, folder / "a.plan"); }).find(bad.second),
              std::string::npos)
        << bad.second;
  EXPECT_NE(refusal([&] { write_mission({}, {}, folder / "a.csv"); }).find(".plan"),
            std::string::npos);
  EXPECT_NE(refusal([&] { write_mission({}, {}, folder / "a.plan"); }).find("no_route"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.plan"));
}

}  // namespace
}  // namespace ridgeway
