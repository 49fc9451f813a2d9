// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// example_live_mapping RECORDING: a roadmap that follows a sensor in one thread while another plans
// on it, from where the sensor was first to where it is now.
#include <atomic>
#include <cstdio>
#include <exception>
#include <thread>

#include "ridgeway/live/graph_delta.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace {

/// Plans on the last snapshot until all scans are in; each snapshot stays as it is meanwhile.
void plan_meanwhile(const ridgeway::LiveRoadmap& live, const ridgeway::Point& start,
                    const std::atomic<std::size_t>& scans, const ridgeway::DepthSequence& all) {
  std::shared_ptr<const ridgeway::Roadmap> last;
  ridgeway::PlanResult path;
  for (std::size_t done = 0; done < all.frames.size(); scans.wait(done), done = scans) {
    const std::shared_ptr<const ridgeway::Roadmap> now = live.snapshot();
    if (now == last) continue;
    if (path.ok() && last) {
      // Without a roadmap there is no room anywhere any more.
      const bool is_safe = now && (!may_be_invalid(path, delta_between(*last, *now)) ||
                                   ridgeway::still_safe(path, *now));
      if (!is_safe) std::printf("the path is blocked now\n");
    }
    last = now;
    path = {};
    if (!now) continue;
    const std::size_t at = done > 0 ? done - 1 : 0;
    path = ridgeway::plan(*now, start, all.frames[at].T_world_camera.translation());
    if (path.ok()) std::printf("after %zu scans: a path of %.2f m\n", at + 1, path.length);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: example_live_mapping RECORDING\n");
    return 1;
  }
  const ridgeway::DepthSequence all = ridgeway::open_sequence(argv[1]);
  ridgeway::LiveRoadmap live({.fusion = {.voxel_size = 0.2, .clear_radius = 0.5},
                              .build = {.min_clearance = 0.3, .max_distance = 3.0}});
  std::atomic<std::size_t> scans = 0;
  const ridgeway::Point start = all.frames.front().T_world_camera.translation();
  std::thread planner([&] { plan_meanwhile(live, start, scans, all); });
  try {
    for (const ridgeway::DepthFrame& frame : all.frames) {
      live.integrate(ridgeway::read_frame(all, frame), all.camera, frame.T_world_camera);
      ++scans;
      scans.notify_one();
    }
  } catch (...) {
    scans = all.frames.size();
    scans.notify_one();
    planner.join();
    throw;
  }
  planner.join();
  if (const auto map = live.settled())
    std::printf("%zu vertices, %zu edges\n", map->graph.vertices.size(), map->graph.edges.size());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
