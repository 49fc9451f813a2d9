// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "state_array.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "common/number_text.hpp"
#include "long_call.hpp"
#include "mapping/state_grid.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway::python {
namespace {

constexpr const char* kExpected =
    "an (nx, ny, nz) array, or one of (nx, ny) for a robot that stays in a plane, of bool (True: "
    "occupied), of whole numbers (0 unknown, 1 free, 2 occupied) or of floats (probability of "
    "being occupied)";

/// Where an array lies, for threads that know nothing of Python.
struct Layout {
  const char* data;
  std::array<std::ptrdiff_t, 3> shape, strides;  // strides in bytes
  bool is_plane;                                 // the array has no third axis

  template <typename Value>
  Value at(std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t z) const {
    Value value;  // which may lie at any address
    std::memcpy(&value, data + x * strides[0] + y * strides[1] + z * strides[2], sizeof value);
    return value;
  }
};

// What values mean, and which do.

template <typename Value>
struct WholeStates {
  static bool is_valid(Value v) { return v >= 0 && v <= 2; }
  /// Unknown where a thread of the caller's has written something else meanwhile.
  VoxelState operator()(Value v) const {
    return is_valid(v) ? static_cast<VoxelState>(v) : VoxelState::kUnknown;
  }
  static constexpr const char* kRemedy = "give 0 (unknown), 1 (free) or 2 (occupied)";
};

template <typename Value>
struct TruthStates {
  static bool is_valid(Value) { return true; }
  VoxelState operator()(Value v) const {
    return v != 0 ? VoxelState::kOccupied : VoxelState::kFree;
  }
  static constexpr const char* kRemedy = "";
};

template <typename Value>
struct Probabilities {
  static bool is_valid(Value v) { return v >= 0 && v <= 1; }  // NaN is none
  VoxelState operator()(Value v) const {
    return v > thresholds.occupied_above ? VoxelState::kOccupied
           : v < thresholds.free_below   ? VoxelState::kFree
                                         : VoxelState::kUnknown;
  }
  static constexpr const char* kRemedy =
      "give probabilities from 0 to 1; 0.5 for what is not known, or an array of whole numbers";
  Thresholds thresholds;
};

/// The first value, in the order of x, y, z, that means nothing.
template <typename Value, typename States>
void require_valid(const Layout& layout, const States& states) {
  const std::ptrdiff_t none = -1;
  std::vector<std::ptrdiff_t> bad(static_cast<std::size_t>(layout.shape[0]), none);
  parallel_for_each_index(bad.size(), [&](std::size_t i) {
    const auto x = static_cast<std::ptrdiff_t>(i);
    for (std::ptrdiff_t y = 0; y < layout.shape[1]; ++y)
      for (std::ptrdiff_t z = 0; z < layout.shape[2]; ++z)
        if (!states.is_valid(layout.at<Value>(x, y, z))) {
          bad[i] = y * layout.shape[2] + z;
          return;
        }
  });
  const auto first = std::find_if(bad.begin(), bad.end(), [](auto place) { return place >= 0; });
  if (first == bad.end()) return;
  const std::ptrdiff_t x = first - bad.begin(), y = *first / layout.shape[2],
                       z = *first % layout.shape[2];
  throw InputError("states[" + std::to_string(x) + ", " + std::to_string(y) +
                       (layout.is_plane ? "" : ", " + std::to_string(z)) + "]",
                   "is " + number_text(layout.at<Value>(x, y, z)), States::kRemedy);
}

template <typename Value, typename States>
OccupancyMap read_map(const Layout& layout, const VoxelIndex& low, double voxel_size,
                      const States& states) {
  require_valid<Value>(layout, states);
  StateGrid grid;
  grid.low = low;
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.shape[axis] = static_cast<int>(layout.shape[axis]);
  grid.read = [&](const VoxelIndex& first, const VoxelIndex& count, VoxelState* block) {
    for (int x = 0; x < count.x; ++x)
      for (int y = 0; y < count.y; ++y)
        for (int z = 0; z < count.z; ++z)
          block[x + 8 * y + 64 * z] =
              states(layout.at<Value>(first.x + x, first.y + y, first.z + z));
  };
  OccupancyMap map = map_from_grid(grid, voxel_size, "states");
  if (!layout.is_plane) return map;
  if (known_range(map).empty())
    throw InputError("states", "has no voxel that is known", "give those that are free at least");
  return flatten(map, low.z * voxel_size, (low.z + 1) * voxel_size);
}

/// The lattice's voxel whose low corner the origin is.
VoxelIndex voxel_at_corner(const Point& origin, double voxel_size) {
  constexpr double kSlack = 1e-6;  // voxels, as everywhere
  std::array<int, 3> voxel{};
  Point nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::round(origin[axis] / voxel_size);
    if (!(std::abs(place) <= kMaxVoxelIndex))
      throw InputError("origin", "is farther than 1e9 voxels from zero", "check its units");
    voxel[static_cast<std::size_t>(axis)] = static_cast<int>(place);
    nearest[axis] = place * voxel_size;
  }
  if (((origin - nearest).cwiseAbs().array() > kSlack * voxel_size).any())
    throw InputError("origin",
                     "is not a whole number of voxels of " + number_text(voxel_size) +
                         " m from zero along each axis",
                     "the nearest that is: (" + number_text(nearest.x()) + ", " +
                         number_text(nearest.y()) + ", " + number_text(nearest.z()) +
                         "); or move the map by OccupancyMap.transformed, which lets obstacles "
                         "grow");
  return {voxel[0], voxel[1], voxel[2]};
}

py::array array_from(py::handle states) {
  if (!py::isinstance<py::array>(states))
    throw py::type_error("states: expected " + std::string(kExpected) + ", got " +
                         describe(states));
  require_no_mask(states, "states");
  auto array = py::reinterpret_borrow<py::array>(states);
  if (array.ndim() != 3 && array.ndim() != 2)
    throw InputError("states", "is " + describe(states), std::string("give ") + kExpected);
  if (!array.dtype().attr("isnative").cast<bool>())
    throw py::type_error(
        "states: is in another byte order than this machine's (use "
        "states.astype(states.dtype.newbyteorder('=')))");
  for (int axis = 0; axis < array.ndim(); ++axis)
    if (array.shape(axis) > kMaxVoxelIndex)
      throw InputError("states", "is " + describe(states), "give 1e9 voxels at most along an axis");
  // Every voxel is looked at: more would take hours, as a view that repeats a value may have them.
  constexpr double kMostVoxels = 1e11;
  double voxels = 1.0;
  for (int axis = 0; axis < array.ndim(); ++axis) voxels *= static_cast<double>(array.shape(axis));
  if (voxels > kMostVoxels)
    throw InputError("states", "is " + describe(states),
                     "give 1e11 voxels at most: cut it down to what is known");
  return array;
}

void require_sensible(const Thresholds& t) {
  if (!(t.free_below >= 0.0 && t.free_below <= t.occupied_above && t.occupied_above <= 1.0))
    throw InputError("free_below and occupied_above",
                     "are " + number_text(t.free_below) + " and " + number_text(t.occupied_above),
                     "give probabilities from 0 to 1, free_below not the larger one");
}

}  // namespace

OccupancyMap map_of_array(py::handle states, double voxel_size, const Point& origin,
                          const Thresholds& thresholds) {
  require_sensible(thresholds);
  const py::array array = array_from(states);
  validate_voxel_size(voxel_size, "voxel_size");
  const VoxelIndex low = voxel_at_corner(origin, voxel_size);
  Layout layout{static_cast<const char*>(array.data()), {1, 1, 1}, {}, array.ndim() == 2};
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    layout.shape[static_cast<std::size_t>(axis)] = array.shape(axis);
    layout.strides[static_cast<std::size_t>(axis)] = array.strides(axis);
  }
  const char kind = array.dtype().kind();
  const py::ssize_t size = array.itemsize();

  const auto whole = [&](auto zero) {
    return read_map<decltype(zero)>(layout, low, voxel_size, WholeStates<decltype(zero)>{});
  };
  const auto real = [&](auto zero) {
    return read_map<decltype(zero)>(layout, low, voxel_size,
                                    Probabilities<decltype(zero)>{thresholds});
  };
  std::optional<OccupancyMap> map = run_stage([&]() -> std::optional<OccupancyMap> {
    if (kind == 'b')
      return read_map<std::uint8_t>(layout, low, voxel_size, TruthStates<std::uint8_t>{});
    if (kind == 'u' && size == 1) return whole(std::uint8_t{});
    if (kind == 'i' && size == 1) return whole(std::int8_t{});
    if (kind == 'u' && size == 2) return whole(std::uint16_t{});
    if (kind == 'i' && size == 2) return whole(std::int16_t{});
    if (kind == 'u' && size == 4) return whole(std::uint32_t{});
    if (kind == 'i' && size == 4) return whole(std::int32_t{});
    if (kind == 'u' && size == 8) return whole(std::uint64_t{});
    if (kind == 'i' && size == 8) return whole(std::int64_t{});
    if (kind == 'f' && size == 4) return real(float{});
    if (kind == 'f' && size == 8) return real(double{});
    return std::nullopt;
  });
  if (!map)
    throw py::type_error("states: expected " + std::string(kExpected) + ", got " +
                         describe(states) + "; use states.astype(np.uint8) or np.float32");
  return *std::move(map);
}

}  // namespace ridgeway::python
