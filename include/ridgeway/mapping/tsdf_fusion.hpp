// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/sensing/depth_camera.hpp"
#include "ridgeway/sensing/solid_mesh.hpp"
#include "ridgeway/voxel/voxel_field.hpp"

namespace ridgeway {

/// A truncated signed distance field: at each voxel centre the distance to the measured surface,
/// negative behind it. Invariant: both fields are on `layout`; |distance| <= truncation.
struct TsdfMap {
  double voxel_size = 0.0;     ///< metres
  VoxelIndex origin = {};      ///< the lattice's voxel that is the map's own (0, 0, 0)
  double truncation = 0.0;     ///< metres; distances are known no farther than this
  BlockLayout layout;          ///< of the map's own voxels
  VoxelField<float> distance;  ///< metres; of no meaning where the weight is 0
  VoxelField<float> weight;    ///< how well it is known; 0: never seen
};

/// Voxels whose centre lies behind the surface are occupied, those before it free, those never
/// seen unknown. What is thinner than a voxel may have no centre behind its surface: a voxel before
/// one, nearer than 0.75 voxels, with free ones across all faces and edges is occupied, too.
/// Normalised.
OccupancyMap occupancy_of(const TsdfMap& tsdf);

/// A surface as triangles, their fronts towards free space. `normals` is as long as `vertices`, and
/// `triangles` hold places in it.
struct SurfaceMesh {
  std::vector<Point> vertices;           ///< metres, world frame
  std::vector<Eigen::Vector3d> normals;  ///< of length one, towards free space
  std::vector<Triangle> triangles;       ///< counter-clockwise seen from free space
};

/// The zero level of a truncated distance field, where a voxel at distance 0 counts as behind the
/// surface. It runs between voxel centres and only where all eight around a place are known: it has
/// borders where the unknown begins and nowhere else. Every edge is that of one triangle at a
/// border, else of two. The same for any number of threads. Throws InputError for a surface of more
/// than 2^31 - 1 vertices.
SurfaceMesh surface_of(const TsdfMap& tsdf);

/// How measurements reach the voxels: each voxel looks up the pixel that sees it, or each point
/// marks the voxels on its ray. Images can take either way, point clouds the second alone.
enum class Integrator : std::uint8_t { kProjective, kRayCasting };

/// Lengths in metres.
struct FusionConfig {
  double voxel_size = 0.1;    ///< of the map
  double truncation = 0.0;    ///< 0: four voxels
  double depth_behind = 0.0;  ///< behind a surface space is solid so far; 0: two voxels
  double min_range = 0.1;     ///< measurements nearer along the ray are passed over
  double max_range = 10.0;    ///< those farther show no surface, and free the way up to here
  bool carve = true;          ///< what lies before a surface becomes free, not only near it
  double max_weight = 1e4;    ///< a voxel never knows better: old measurements fade
  /// Measurements in a row that find a voxel on the other side of the surface than it is taken to
  /// be, by half a voxel or more, and it is taken as the last one finds it: what was moved is
  /// forgotten after so many looks, however well it was known. 0: never, it fades.
  int forget_after = 0;
  /// Metres around every pose in which what nothing has measured is free, as the robot was there;
  /// obstacles that were measured stay. 0: none.
  double clear_radius = 0.0;
  Integrator integrator = Integrator::kProjective;  ///< of depth images
  /// The lattice's voxel that is the map's own (0, 0, 0); left out: that which holds the sensor at
  /// the first pose.
  std::optional<VoxelIndex> origin = {};
  bool can_undo = false;  ///< keeps what the last measurements overwrote, see TsdfFusion::undo

  /// Whether a measurement at a range, metres along the ray, is taken; none is that is no number,
  /// or less than a micrometre, whose weight would be none.
  bool takes(double range) const {
    return range >= 1e-6 && range >= min_range && range <= max_range;
  }
  /// Whether a measurement at a range, metres along the ray, is of something farther than is taken:
  /// what lies before max_range is free then, if `carve` is. Not at more than 20 times that: such
  /// are mistakes of the unit, and the ends of simulated cameras' sight.
  bool is_beyond(double range) const { return range > max_range && range <= 20.0 * max_range; }

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Fuses depth measurements with known poses into a truncated signed distance field (Curless and
/// Levoy 1996). The distance of a voxel to a measured pixel is that to the plane of the surface
/// there, so that surfaces seen at a slant are not off; weights fall with the square of the depth,
/// with the slant, and behind the surface. Same measurements in the same order, same bits, for any
/// number of threads. Memory follows what was seen. The map's origin is the voxel that held the
/// sensor at the first pose, so poses far from the world's zero cost no exactness; nothing may be
/// seen farther than 1e9 voxels from that zero, or 5e8 from the first pose. Not thread-safe.
class TsdfFusion {
 public:
  /// Throws InputError naming the bad field.
  explicit TsdfFusion(const FusionConfig& config = {});
  ~TsdfFusion();
  TsdfFusion(TsdfFusion&&) noexcept;  ///< The one moved from can only be assigned to or destroyed.
  /// The one moved from can only be assigned to or destroyed.
  TsdfFusion& operator=(TsdfFusion&&) noexcept;

  /// A depth image of a camera with a pose (camera to world). Throws InputError where the image
  /// does not fit the camera, the pose is no rotation and translation, or memory runs out: then the
  /// map is as it was before.
  void integrate(const DepthImage& image, const PinholeCamera& camera,
                 const Eigen::Isometry3d& T_world_camera);

  /// Points in the sensor's frame, metres, its origin at 0; those not finite are passed over.
  /// Throws InputError where the pose is no rotation and translation, or memory runs out, as above.
  void integrate(std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor);

  /// All that was fused so far.
  TsdfMap map() const;

  /// The voxels of the lattice whose state, as occupancy_of(map()) has it, is another than when
  /// changes were last accepted, with what it is; at first they all are unknown. By block in
  /// (z, y, x) order, then by voxel. Takes time linear in the blocks that were touched since then.
  std::vector<VoxelChange> find_changes();
  /// Accepts what find_changes has found, if nothing was fused since.
  void accept_changes() noexcept;

  /// The blocks that measurements have reached since changes were last accepted, those of the map
  /// itself, in no order that means anything.
  std::vector<BlockIndex> reached_blocks() const;

  /// A fusion with the same configuration and origin that measurements reach in some blocks alone,
  /// with nothing in it yet: for fusing these again. Throws InputError where nothing was fused yet
  /// and no origin is given.
  TsdfFusion within_blocks(std::span<const BlockIndex> blocks) const;
  /// Takes over the blocks of such a fusion, those with nothing in them too, and all places of the
  /// sensor, metres, world frame, in order: what was fused into them before is forgotten. Can be
  /// undone, as measurements can.
  void take_over(const TsdfFusion& part, std::span<const Point> places_world);

  /// Takes back the last measurements, once, if they can be (FusionConfig::can_undo) and their
  /// changes were not accepted yet.
  void undo() noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ridgeway
