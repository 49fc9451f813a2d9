// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;
constexpr double kEndless = std::numeric_limits<double>::infinity();

// --- distances
// ------------------------------------------------------------------------------------

SurfaceDistance distance_to(const SolidPlane& plane, const Point& p) {
  return {plane.normal.dot(p) - plane.offset, plane.normal};
}

SurfaceDistance distance_to(const SolidBox& box, const Point& p) {
  const Vector from_centre = p - box.centre;
  const Vector side = from_centre.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
  const Vector over = from_centre.cwiseAbs() - 0.5 * box.size;
  if ((over.array() > 0.0).any()) {
    const Vector outside = over.cwiseMax(0.0);
    const double distance = outside.norm();
    return {distance, outside.cwiseProduct(side) / distance};
  }
  Eigen::Index axis = 0;
  const double depth = over.maxCoeff(&axis);
  return {depth, Vector::Unit(axis) * side[axis]};
}

SurfaceDistance distance_to(const SolidSphere& sphere, const Point& p) {
  const Vector from_centre = p - sphere.centre;
  const double norm = from_centre.norm();
  return {norm - sphere.radius, norm > 0.0 ? Vector(from_centre / norm) : Vector::UnitX()};
}

SurfaceDistance distance_to(const SolidCylinder& cylinder, const Point& p) {
  const Vector from_centre = p - cylinder.centre;
  const double norm = from_centre.head<2>().norm();
  const Vector outward =
      norm > 0.0 ? Vector(from_centre.x() / norm, from_centre.y() / norm, 0.0) : Vector::UnitX();
  const Vector upward(0.0, 0.0, from_centre.z() < 0.0 ? -1.0 : 1.0);
  const double beside = norm - cylinder.radius;
  const double above = std::abs(from_centre.z()) - 0.5 * cylinder.height;
  if (beside > 0.0 && above > 0.0) {
    const double distance = std::hypot(beside, above);
    return {distance, (beside * outward + above * upward) / distance};
  }
  return beside > above ? SurfaceDistance{beside, outward} : SurfaceDistance{above, upward};
}

SurfaceDistance distance_to(const PlacedMesh& placed, const Point& p) {
  const Point in_mesh = placed.T_world_mesh.inverse() * p / placed.scale;
  const SurfaceDistance here = placed.mesh->distance(in_mesh);
  return {placed.scale * here.distance, placed.T_world_mesh.linear() * here.gradient};
}

// --- rays
// -----------------------------------------------------------------------------------------

/// The stretch of a ray inside a convex solid: empty if first > last.
struct Stretch {
  double first = -kEndless, last = kEndless;
};

Stretch common(const Stretch& a, const Stretch& b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// Where |start + t * step| <= half.
Stretch inside_slab(double start, double step, double half) {
  if (step == 0.0) return std::abs(start) <= half ? Stretch{} : Stretch{kEndless, -kEndless};
  const double a = (-half - start) / step, b = (half - start) / step;
  return {std::min(a, b), std::max(a, b)};
}

/// Where a t^2 + 2 b t + c <= 0, a >= 0.
Stretch inside_quadric(double a, double b, double c) {
  if (a == 0.0) return c <= 0.0 ? Stretch{} : Stretch{kEndless, -kEndless};
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return {kEndless, -kEndless};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));  // no cancellation
  const double one = q / a, other = q != 0.0 ? c / q : 0.0;
  return {std::min(one, other), std::max(one, other)};
}

Stretch inside(const SolidPlane& plane, const Point& origin, const Vector& direction) {
  const double height = plane.normal.dot(origin) - plane.offset;
  const double slope = plane.normal.dot(direction);
  if (slope == 0.0) return height <= 0.0 ? Stretch{} : Stretch{kEndless, -kEndless};
  const double meets = -height / slope;
  return slope < 0.0 ? Stretch{meets, kEndless} : Stretch{-kEndless, meets};
}

Stretch inside(const SolidBox& box, const Point& origin, const Vector& direction) {
  Stretch stretch;
  for (int axis = 0; axis < 3; ++axis)
    stretch = common(stretch, inside_slab(origin[axis] - box.centre[axis], direction[axis],
                                          0.5 * box.size[axis]));
  return stretch;
}

Stretch inside(const SolidSphere& sphere, const Point& origin, const Vector& direction) {
  const Vector from_centre = origin - sphere.centre;
  return inside_quadric(direction.squaredNorm(), from_centre.dot(direction),
                        from_centre.squaredNorm() - sphere.radius * sphere.radius);
}

Stretch inside(const SolidCylinder& cylinder, const Point& origin, const Vector& direction) {
  const Vector from_centre = origin - cylinder.centre;
  const auto o = from_centre.head<2>(), d = direction.head<2>();
  const Stretch round = inside_quadric(d.squaredNorm(), o.dot(d),
                                       o.squaredNorm() - cylinder.radius * cylinder.radius);
  return common(round, inside_slab(from_centre.z(), direction.z(), 0.5 * cylinder.height));
}

/// Where a ray meets a solid, 0 from inside; infinite if nowhere.
template <typename Convex>
double range_to(const Convex& solid, const Point& origin, const Vector& direction) {
  const Stretch stretch = inside(solid, origin, direction);
  const bool is_met = stretch.first <= stretch.last && stretch.last >= 0.0;
  return is_met ? std::max(stretch.first, 0.0) : kEndless;
}

double range_to(const PlacedMesh& placed, const Point& origin, const Vector& direction) {
  const Point in_mesh = placed.T_world_mesh.inverse() * origin / placed.scale;
  const Vector along = placed.T_world_mesh.linear().transpose() * direction;
  return placed.scale * placed.mesh->cast_ray(in_mesh, along);
}

template <typename Body>
void for_each_solid(const World& world, const Body& body) {
  for (const SolidPlane& solid : world.planes) body(solid);
  for (const SolidBox& solid : world.boxes) body(solid);
  for (const SolidSphere& solid : world.spheres) body(solid);
  for (const SolidCylinder& solid : world.cylinders) body(solid);
  for (const PlacedMesh& solid : world.meshes) body(solid);
}

// --- validation
// -----------------------------------------------------------------------------------

void require(bool holds, const std::string& kind, std::size_t place, const char* what,
             const char* remedy) {
  if (!holds) throw InputError(kind + " " + std::to_string(place + 1), what, remedy);
}

template <typename Solids, typename IsGood>
void validate_all(const Solids& solids, const std::string& kind, const IsGood& is_good) {
  for (std::size_t i = 0; i < solids.size(); ++i) {
    require(solids[i].centre.allFinite(), kind, i, "has a centre that is not finite",
            "give three coordinates in metres");
    require(is_good(solids[i]), kind, i, "has no size", "give finite lengths above 0 metres");
  }
}

bool is_placement(const Eigen::Isometry3d& T) {
  return T.matrix().allFinite() && T.linear().isUnitary(1e-9) && T.linear().determinant() > 0.0;
}

bool is_length(double value) { return value > 0.0 && std::isfinite(value); }

/// Boxes, spheres and cylinders of a world, or of some that are timed.
template <typename Solids>
void validate_round_and_square(const Solids& solids) {
  validate_all(solids.boxes, "box", [](const SolidBox& box) {
    return is_length(box.size.x()) && is_length(box.size.y()) && is_length(box.size.z());
  });
  validate_all(solids.spheres, "sphere",
               [](const SolidSphere& sphere) { return is_length(sphere.radius); });
  validate_all(solids.cylinders, "cylinder", [](const SolidCylinder& cylinder) {
    return is_length(cylinder.radius) && is_length(cylinder.height);
  });
}

template <typename Solid>
void append(std::vector<Solid>& to, const std::vector<Solid>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

void validate_world(const World& world) {
  for (std::size_t i = 0; i < world.planes.size(); ++i) {
    const SolidPlane& plane = world.planes[i];
    require(std::abs(plane.normal.norm() - 1.0) < 1e-9, "plane", i, "has no normal of length one",
            "give the direction into the open");
    require(std::isfinite(plane.offset), "plane", i, "has an offset that is not finite",
            "give metres along the normal");
  }
  validate_round_and_square(world);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    const PlacedMesh& placed = world.meshes[i];
    require(placed.mesh != nullptr, "mesh", i, "has no triangles", "read or make some");
    require(is_length(placed.scale), "mesh", i, "has no size", "give a finite scale above 0");
    require(is_placement(placed.T_world_mesh), "mesh", i, "has no place",
            "give a rotation and finite metres");
  }
  for (std::size_t i = 0; i < world.timed.size(); ++i) {
    const TimedSolids& timed = world.timed[i];
    require(timed.from < timed.until, "timed solids", i, "are never there",
            "give seconds from and until, the first less than the second");
    try {
      validate_round_and_square(timed);
    } catch (const InputError& error) {
      throw error.within("timed solids " + std::to_string(i + 1));
    }
  }
}

namespace {

/// The world with those timed solids that `is_there`.
template <typename IsThere>
World world_with(const World& world, const IsThere& is_there) {
  World now = world;
  now.timed.clear();
  for (const TimedSolids& timed : world.timed) {
    if (!is_there(timed)) continue;
    append(now.boxes, timed.boxes);
    append(now.spheres, timed.spheres);
    append(now.cylinders, timed.cylinders);
  }
  return now;
}

}  // namespace

World world_at(const World& world, double time) {
  return world_with(
      world, [time](const TimedSolids& timed) { return time >= timed.from && time < timed.until; });
}

World world_at_all_times(const World& world) {
  return world_with(world, [](const TimedSolids&) { return true; });
}

SurfaceDistance surface_distance(const World& world, const Point& point) {
  SurfaceDistance nearest{kEndless, Vector::UnitZ()};
  for_each_solid(world, [&](const auto& solid) {
    const SurfaceDistance here = distance_to(solid, point);
    if (here.distance < nearest.distance) nearest = here;
  });
  return nearest;
}

double cast_ray(const World& world, const Point& origin, const Vector& direction) {
  double nearest = kEndless;
  for_each_solid(world, [&](const auto& solid) {
    nearest = std::min(nearest, range_to(solid, origin, direction));
  });
  return nearest;
}

}  // namespace ridgeway
