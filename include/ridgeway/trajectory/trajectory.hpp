// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// Flat outputs of a multirotor: x, y, z (metres, world frame) and yaw (radians, unwrapped).
inline constexpr int kFlatOutputs = 4;
/// Coefficients of a segment's polynomials: degree 9 at most.
inline constexpr int kCoefficients = 10;

/// The derivative whose squared integral is smallest.
enum class Smoothness : std::uint8_t {
  kJerk = 3,  ///< pieces of degree 7
  kSnap = 4,  ///< pieces of degree 9
};

/// One polynomial piece: output d at t seconds from the piece's start is
/// sum over k of coefficients(d, k) t^k.
struct TrajectorySegment {
  double duration = 0.0;  ///< seconds, >= 0
  /// A row for each output, a column for each power of t; SI units, radians.
  Eigen::Matrix<double, kFlatOutputs, kCoefficients> coefficients =
      Eigen::Matrix<double, kFlatOutputs, kCoefficients>::Zero();

  /// A derivative (0: the value itself) of all outputs at t seconds from the piece's start.
  Eigen::Vector4d derivative(int order, double t) const;
};

/// Where a trajectory is at a time.
struct TrajectoryState {
  double time = 0.0;                   ///< seconds from the start
  Point position = Point::Zero();      ///< metres
  Point velocity = Point::Zero();      ///< m/s
  Point acceleration = Point::Zero();  ///< m/s^2
  double yaw = 0.0;                    ///< radians, unwrapped: never jumps by 2 pi
  double yaw_rate = 0.0;               ///< rad/s
};

/// A motion in time: polynomial pieces one after another. Those that plan_trajectory makes join
/// with four continuous derivatives (three where jerk is minimised), and are plain data.
struct Trajectory {
  std::vector<TrajectorySegment> segments;  ///< in the order of time

  double duration() const;  ///< seconds
  /// Times before the start and after the end are those of the ends. Throws InputError without
  /// segments: a result that is not ok() has none.
  TrajectoryState at(double time) const;
  /// States every `step` seconds, and at the end; empty without segments. Linear in their number.
  /// Throws InputError where the step is not finite and above 0, or gives more than ten million.
  std::vector<TrajectoryState> sample(double step) const;
};

/// Largest magnitudes along a trajectory. Certified: never below the true maximum, and above it by
/// at most a share of 1e-6 (of 1e-9 in absolute terms near zero). Found by bisecting the Bernstein
/// forms of the squared derivatives, which bound them between the samples too.
struct MotionPeaks {
  double speed = 0.0;         ///< m/s
  double acceleration = 0.0;  ///< m/s^2
  double jerk = 0.0;          ///< m/s^3
  double yaw_rate = 0.0;      ///< rad/s
};
MotionPeaks find_peaks(const TrajectorySegment& segment);  ///< Of one piece.
MotionPeaks find_peaks(const Trajectory& trajectory);      ///< Of all pieces together.

/// What a trajectory may ask of the robot: magnitudes of the vectors, not of single axes.
struct MotionLimits {
  double max_speed = 2.0;                                     ///< m/s
  double max_acceleration = 2.0;                              ///< m/s^2
  double max_jerk = std::numeric_limits<double>::infinity();  ///< m/s^3
  double max_yaw_rate = 0.5 * std::numbers::pi;               ///< rad/s

  /// Throws InputError naming the field that is not from 1e-9 to 1e9; the last two may be more.
  void validate() const;

  /// Whether a motion with such peaks keeps every limit.
  bool hold(const MotionPeaks& peaks) const {
    return peaks.speed <= max_speed && peaks.acceleration <= max_acceleration &&
           peaks.jerk <= max_jerk && peaks.yaw_rate <= max_yaw_rate;
  }
};

}  // namespace ridgeway
