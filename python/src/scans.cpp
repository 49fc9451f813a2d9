// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Lidars and recordings of scans.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>

#include "config.hpp"
#include "faces.hpp"
#include "lock.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "sensors.hpp"

namespace ridgeway::python {
namespace {

SpinningLidar make_lidar(py::handle rows, py::handle columns, py::handle vertical,
                         py::handle min_range, py::handle max_range, py::handle range_sigma) {
  SpinningLidar lidar;
  read(rows, "rows", lidar.rows);
  read(columns, "columns", lidar.columns);
  read(vertical, "vertical", lidar.vertical);
  read(min_range, "min_range", lidar.min_range);
  read(max_range, "max_range", lidar.max_range);
  read(range_sigma, "range_sigma", lidar.range_sigma);
  lidar.validate();
  return lidar;
}

std::string lidar_repr(const SpinningLidar& l) {
  return "SpinningLidar(rows=" + literal(l.rows) + ", columns=" + literal(l.columns) +
         ", vertical=" + literal(l.vertical) + ", min_range=" + literal(l.min_range) +
         ", max_range=" + literal(l.max_range) + ", range_sigma=" + literal(l.range_sigma) + ")";
}

py::dict view_of_lidar(const SpinningLidar& lidar, py::handle share_of_range, py::handle row_gap) {
  const double share = number_from(share_of_range, "share_of_range");
  std::optional<double> gap;
  read(row_gap, "row_gap", gap);
  return python::dict_of(gap ? field_of_view(lidar, share, *gap) : field_of_view(lidar, share));
}

void add_lidar(py::module_& module) {
  constexpr const char* kSignature =
      "rows=32, columns=640, vertical=1.0, min_range=0.0, max_range=10.0, range_sigma=0.0";
  py::class_<SpinningLidar>(
      module, "SpinningLidar",
      (std::string("SpinningLidar(") + kSignature +
       ")\n--\n\n"
       "A lidar that spins about its upright axis: rows of beams at even angles over `vertical` "
       "radians, level in the\nmiddle, each fired in all columns around; ranges and their Gaussian "
       "noise in metres. Its frame: x forward,\ny left, z up.")
          .c_str())
      .def(py::init(&make_lidar), py::arg("rows") = 32, py::arg("columns") = 640,
           py::arg("vertical") = 1.0, py::arg("min_range") = 0.0, py::arg("max_range") = 10.0,
           py::arg("range_sigma") = 0.0,
           (std::string("__init__(self, ") + kSignature + ")\n--\n\n").c_str())
      .def_readonly("rows", &SpinningLidar::rows, "One above the other.")
      .def_readonly("columns", &SpinningLidar::columns, "In a turn.")
      .def_readonly("vertical", &SpinningLidar::vertical, "Radians.")
      .def_readonly("min_range", &SpinningLidar::min_range, "Metres.")
      .def_readonly("max_range", &SpinningLidar::max_range, "Metres.")
      .def_readonly("range_sigma", &SpinningLidar::range_sigma, "Metres.")
      .def("field_of_view", &view_of_lidar, py::arg("share_of_range") = 0.7,
           py::arg("row_gap") = py::none(),
           "field_of_view(self, share_of_range=0.7, row_gap=None)\n--\n\n"
           "What it sees, as keyword arguments of Explorer; counting on a share of its range. Rows "
           "are no farther apart\nthan row_gap metres at the end of the range: the size of voxels.")
      .def("__repr__", &lidar_repr);
}

py::object scan_of(const ScanSequence& sequence, py::handle index) {
  const Scan& scan = sequence.scans[place_from(index, sequence.scans.size(), "scans")];
  PointCloud cloud;
  {
    const Unlocked unlocked;
    cloud = read_scan(scan);
  }
  return py::make_tuple(python::array_of(std::move(cloud.points)),
                        python::array_of(scan.T_world_sensor));
}

void add_sequence(py::module_& module) {
  py::class_<ScanSequence>(
      module, "ScanSequence",
      "A recording of scans with poses; sequence[i] is the i-th: (points, T_world_sensor), points "
      "(N, 3) in the\nsensor's frame.")
      .def_readonly("layout", &ScanSequence::layout, "'scans' or 'registration'.")
      .def_readonly("without_pose", &ScanSequence::without_pose,
                    "Scans whose pose is not finite, passed over.")
      .def("__len__", [](const ScanSequence& sequence) { return sequence.scans.size(); })
      .def(
          "__getitem__",
          [](const ScanSequence& sequence, py::handle index) {
            return item_or_slice(index, sequence.scans.size(),
                                 [&](py::handle place) { return scan_of(sequence, place); });
          },
          py::arg("index"))
      .def("__iter__", &iterator_of)
      .def("__repr__", [](const ScanSequence& sequence) {
        return "ScanSequence(" + std::to_string(sequence.scans.size()) + " scans, layout='" +
               sequence.layout + "')";
      });
  module.def(
      "open_scans",
      [](py::handle folder) {
        const std::filesystem::path path = path_from(folder, "folder");
        const Unlocked unlocked;
        return open_scans(path);
      },
      py::arg("folder"),
      "open_scans(folder)\n--\n\n"
      "A recording of lidar scans with poses (poses.txt, or a registration): a ScanSequence.");
}

/// A ScanWriter that may be asked by several threads, and once it has finished.
class ScanWriterFace {
 public:
  explicit ScanWriterFace(py::handle folder) {
    const std::filesystem::path path = path_from(folder, "folder");
    const Unlocked unlocked;
    writer_ = std::make_unique<ScanWriter>(path);
  }

  void add(py::handle points, py::handle pose) {
    std::vector<Point> cloud = cloud_from(points);
    const Eigen::Isometry3d T_world_sensor = pose_from(pose, "T_world_sensor");
    const Unlocked unlocked;
    std::erase_if(cloud, [](const Point& p) { return !p.allFinite(); });
    const std::scoped_lock lock(mutex_);
    writer().add(cloud, T_world_sensor);
    ++count_;
  }

  void finish() {
    const Unlocked unlocked;
    const std::scoped_lock lock(mutex_);
    writer().finish();
    writer_.reset();
  }

  /// The end of a with statement: what was begun when something went wrong is taken away.
  void leave(py::handle error) {
    const bool is_well = error.is_none();
    {
      const Unlocked unlocked;
      const std::scoped_lock lock(mutex_);
      if (!writer_) return;
      if (!is_well) return writer_.reset();
    }
    finish();
  }

  std::size_t count() const { return count_; }

 private:
  ScanWriter& writer() {
    if (!writer_) throw InputError("scans", "are written already", "make another ScanWriter");
    return *writer_;
  }

  std::mutex mutex_;
  std::unique_ptr<ScanWriter> writer_;
  std::size_t count_ = 0;
};

void add_writer(py::module_& module) {
  py::class_<ScanWriterFace>(
      module, "ScanWriter",
      "ScanWriter(folder)\n--\n\n"
      "Writes a recording that open_scans and `ridgeway fuse` read: poses.txt, and clouds as "
      "binary "
      ".ply of single\nprecision. The folder must not exist or be empty; it appears whole, by "
      "finish() or at the end of a with\nstatement, or not at all.")
      .def(py::init<py::handle>(), py::arg("folder"), "__init__(self, folder)\n--\n\n")
      .def("add", method(&ScanWriterFace::add), py::arg("points"), py::arg("T_world_sensor"),
           "add(self, points, T_world_sensor)\n--\n\n"
           "The next scan: points (N, 3), metres, in the sensor's frame, its origin at 0; its pose "
           "(4, 4). Points that are\nnot finite are left out.")
      .def("finish", method(&ScanWriterFace::finish),
           "finish(self)\n--\n\nPuts the folder in its place.")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<const ScanWriterFace&>();  // None is none
             return self;
           })
      .def("__exit__", [](ScanWriterFace& writer, py::handle error, py::handle,
                          py::handle) { writer.leave(error); })
      .def("__len__", method(&ScanWriterFace::count))
      .def("__repr__", [](const ScanWriterFace& writer) {
        return "ScanWriter(" + std::to_string(writer.count()) + " scans)";
      });
}

}  // namespace

void add_scans(py::module_& module) {
  add_lidar(module);
  add_sequence(module);
  add_writer(module);
}

}  // namespace ridgeway::python
