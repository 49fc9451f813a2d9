// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include "common/number_text.hpp"
#include "load_steps.hpp"
#include "mapping/mesh_map.hpp"
#include "mapping/solid_voxels.hpp"
#include "mesh_file.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/formats/world_file.hpp"

namespace ridgeway {
namespace {

std::string size_text(const Box& box) {
  const Eigen::Vector3d size = box.max - box.min;
  std::ostringstream text;
  text << std::setprecision(4) << size.x() << " x " << size.y() << " x " << size.z() << " m";
  return text.str();
}

std::string millimetres_text(double metres) {
  return number_text(std::round(1e3 * metres) / 1e3 + 0.0);  // not -0
}

std::string point_text(const Point& p) {
  return millimetres_text(p.x()) + "," + millimetres_text(p.y()) + "," + millimetres_text(p.z());
}

std::string box_text(const Box& box) { return point_text(box.min) + " to " + point_text(box.max); }

void tell_of_frame(const MeshFrame& own, const LoadConfig& config, LoadNotes* notes) {
  const bool unit_known = own.unit || config.units, up_known = own.up || config.up;
  if (unit_known && up_known) return;
  const std::string what = unit_known ? "the file names no upward axis: z is taken (option up)"
                           : up_known ? "the file names no unit: metres are taken (option units)"
                                      : "the file names no unit and no upward axis: metres and z "
                                        "are taken (options units, up)";
  tell(notes, what);
}

std::string enclosed_text(const MeshMapReport& report) {
  if (report.enclosed == 0) return " (option inside)";
  const std::string spaces = report.enclosed == 1
                                 ? "; a space that the mesh encloses is taken as solid, of "
                                 : "; " + std::to_string(report.enclosed) +
                                       " spaces that the mesh encloses are taken as solid, the "
                                       "largest of ";
  return spaces + millimetres_text(report.largest_enclosed) + " m3 (option inside " +
         point_text(report.in_largest) + " takes that one as free, all else as unknown)";
}

void tell_of_space(const MeshMapReport& report, const LoadConfig& config, LoadNotes* notes) {
  if (!config.bounds)
    tell(notes, "the map ends where the mesh does, which spans " + size_text(report.box) + ", " +
                    box_text(report.box) + " (option bounds)");
  using Free = MeshMapReport::Free;
  if (report.free == Free::kWithin)
    tell(notes,
         "the mesh encloses more space than there is around it within the bounds: what it "
         "encloses is taken as free (option inside)");
  else if (report.free == Free::kAround)
    tell(notes, "what is reached from the bounds is taken as free, outside the mesh too" +
                    enclosed_text(report));
  if (report.leak)
    tell(notes, "the space is not closed: it is open to the bounds at " +
                    point_text(report.leak->exit) + "; the widest way there is narrowest, about " +
                    millimetres_text(report.leak->width) + " m, at " +
                    point_text(report.leak->narrowest) +
                    "; close it where it is not meant to be open (options exclude, bounds)");
}

/// A building that lies on its side is wide along z, and thin along y.
void tell_of_upward_axis(const MeshFrame& own, const Box& box, const LoadConfig& config,
                         LoadNotes* notes) {
  if (own.up || config.up) return;
  constexpr double kThin = 3.0;
  const Eigen::Vector3d size = box.max - box.min;
  if (kThin * size.y() < std::min(size.x(), size.z()))
    tell(notes, "it spans " + size_text(box) +
                    ": if that lies on its side, y is its upward axis "
                    "(option up)");
}

/// Fine enough for the smallest radius that a roadmap is for unless another is given, four voxels.
constexpr double kUsualVoxelSize = 0.1;

void tell_of_voxels(const LoadConfig& config, LoadNotes* notes) {
  if (!config.voxel_size) tell(notes, "voxels of 0.1 m are taken (option voxel_size)");
}

/// What is said of a mesh that no map can be made of: one that names no unit is most often in
/// millimetres.
[[noreturn]] void refuse_again(const InputError& error, const TriangleSoup& mesh) {
  Box box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Point& v : mesh.vertices) box = {box.min.cwiseMin(v), box.max.cwiseMax(v)};
  throw InputError(error.where(), error.problem(),
                   "it names no unit, and spans " + size_text(box) +
                       " if that is metres: give units if it is not; else " + error.remedy());
}

/// Coordinates far from zero are known to some part of a voxel alone.
void account_for_rounding(TriangleSoup& mesh, double voxel_size, const std::string& name,
                          LoadNotes* notes) {
  constexpr double kNothing = 1e-3, kTooMuch = 0.5;  // voxels
  if (mesh.off <= kNothing * voxel_size) {
    mesh.off = 0.0;
    return;
  }
  const std::string off = number_text(std::ceil(1e4 * mesh.off) / 1e4) + " m";
  const char* const remedy = "write it near zero, and say with transform where that is";
  if (!(mesh.off <= kTooMuch * voxel_size))
    throw InputError(name,
                     "lies so far from zero that its coordinates, in single precision, are "
                     "off by " +
                         off,
                     remedy);
  tell(notes, "its coordinates, in single precision so far from zero, may be off by " + off +
                  ": surfaces are so much thicker (" + remedy + ")");
  mesh.off *= std::sqrt(3.0);  // whatever way it is turned
}

}  // namespace

OccupancyMap load_mesh_map(const std::filesystem::path& file, std::string_view bytes,
                           const std::string& format, const LoadConfig& config, LoadNotes* notes) {
  const std::string name = file.string();
  TriangleSoup mesh = read_mesh(file, bytes, format, {config.units, config.up});
  const MeshFrame own = mesh_frame(format, bytes);
  tell_of_frame(own, config, notes);
  account_for_rounding(mesh, config.voxel_size.value_or(kUsualVoxelSize), name, notes);
  for (Point& v : mesh.vertices) v = config.transform * v;
  tell_of_voxels(config, notes);
  MeshMapReport report;
  OccupancyMap map;
  try {
    map = map_from_mesh(mesh,
                        {.voxel_size = config.voxel_size.value_or(kUsualVoxelSize),
                         .bounds = config.bounds,
                         .inside = config.inside,
                         .margin = config.isolated_below},
                        name, &report);
  } catch (const InputError& error) {
    if (own.unit || config.units || error.where() != name || mesh.vertices.empty()) throw;
    refuse_again(error, mesh);
  }
  tell_of_upward_axis(own, report.box, config, notes);
  tell_of_space(report, config, notes);
  return finished(std::move(map), config, name, notes);
}

OccupancyMap load_world_map(const std::filesystem::path& file, const LoadConfig& config,
                            LoadNotes* notes) {
  const std::string name = file.string();
  World world = load_world(file);
  if (!world.timed.empty()) {
    tell(notes, "solids that are there for a time (timed) are in the map, whenever that is");
    world = world_at_all_times(world);
  }
  const auto extent = extent_of(world);
  if (!config.transform.isApprox(Eigen::Isometry3d::Identity(), 0.0))
    throw InputError("transform", "cannot move a world, which is in its own frame",
                     "leave it out, or write the world elsewhere");
  if (!config.bounds && !extent)
    throw InputError(name, "has no end in some direction", "give bounds");
  const Box bounds = config.bounds.value_or(extent ? *extent : Box{});
  if (!bounds.min.allFinite() || !bounds.max.allFinite())
    throw InputError("bounds", "are not finite", "give finite bounds around the space to fly in");
  tell_of_voxels(config, notes);
  if (!config.bounds)
    tell(notes, "the map ends where the world does, " + box_text(bounds) + " (option bounds)");
  OccupancyMap map = touched_by(world, config.voxel_size.value_or(kUsualVoxelSize), bounds, name);
  return finished(std::move(map), config, name, notes);
}

}  // namespace ridgeway
