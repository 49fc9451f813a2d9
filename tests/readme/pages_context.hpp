// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// What the C++ in docs/ takes for granted: a robot, its sensor, a roadmap. Declared alone, as the
// pages are compiled and not linked.
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>
#include <ridgeway/ridgeway.hpp>
#include <ridgeway/sampling/ompl.hpp>
#include <span>
#include <string_view>
#include <vector>

// A robot.
bool flying();
void warn(std::string_view text);
void follow(const std::vector<ridgeway::Point>& waypoints);
void fly(const ridgeway::Trajectory& trajectory);
void hover(std::string_view why);
void brake();
void stop();

// Its sensor.
struct DepthMessage {
  ridgeway::DepthImage image;
  ridgeway::PinholeCamera camera;
  Eigen::Isometry3d T_world_camera;
};
DepthMessage next_image();
extern const ridgeway::DepthImage image;
extern const ridgeway::PinholeCamera camera;
extern const ridgeway::DepthSensor sensor;
extern const Eigen::Isometry3d T_world_camera;
extern const std::vector<ridgeway::VoxelChange> changes;
extern const std::vector<ridgeway::PoseCorrection> corrections;

// What ROS has of a map and of a cloud.
struct OccupancyGridMessage {
  struct {
    float resolution;
    unsigned width, height;
    struct {
      struct {
        double x, y, z;
      } position;
    } origin;
  } info;
  std::vector<signed char> data;
};
struct CloudPoint {
  float x, y, z;
};
extern const OccupancyGridMessage grid;
extern const std::vector<CloudPoint> cloud_points;
extern const Eigen::Isometry3d T_world_sensor;

// Where it is, and what it knows.
extern const ridgeway::Point position, start, goal;
extern const ridgeway::FlightState state;
extern const ridgeway::Roadmap roadmap;
extern ridgeway::LiveRoadmap live;
extern const std::shared_ptr<const ridgeway::Roadmap> before;
extern const ridgeway::PlanResult path;
extern const double radius;
