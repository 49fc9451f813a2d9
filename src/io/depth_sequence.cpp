// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/io/depth_sequence.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <system_error>
#include <tuple>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"
#include "ridgeway/io/atomic_file.hpp"
#include "ridgeway/io/depth_png.hpp"
#include "ridgeway/io/read_file.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

constexpr double kTumUnits = 5000.0, kSevenScenesUnits = 1000.0;  // of an image, a metre
constexpr double kFrameSeconds = 0.1;                             // between simulated images
const char* const kIntrinsicsFile = "camera-intrinsics.txt";

/// The lines of a text file, split at blanks and commas, without comments and empty lines.
struct Line {
  std::size_t number;
  std::vector<std::string> words;
};

std::vector<Line> read_lines(const fs::path& file) {
  std::istringstream text(read_file(file));
  std::vector<Line> lines;
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    line.resize(std::min(line.size(), line.find('#')));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == '\r'; }, ' ');
    std::istringstream words(line);
    Line split{number, {}};
    for (std::string word; words >> word;) split.words.push_back(word);
    if (!split.words.empty()) lines.push_back(std::move(split));
  }
  return lines;
}

[[noreturn]] void refuse(const fs::path& file, std::size_t line, const std::string& what,
                         const std::string& remedy) {
  throw InputError(file.string() + " line " + std::to_string(line), what, remedy);
}

/// A number; "nan" and "inf" are numbers too.
double number_in(const fs::path& file, const Line& line, std::size_t place,
                 const std::string& remedy) {
  double value = 0.0;
  if (place >= line.words.size()) refuse(file, line.number, "is too short", remedy);
  const std::string& word = line.words[place];
  const char* first = word.data() + (word.front() == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    refuse(file, line.number, "has '" + word + "', which is no number", remedy);
  return value;
}

/// All numbers of a file of rows.
std::vector<double> numbers_of(const fs::path& file, std::size_t count, const char* remedy) {
  std::vector<double> numbers;
  for (const Line& line : read_lines(file))
    for (std::size_t i = 0; i < line.words.size(); ++i)
      numbers.push_back(number_in(file, line, i, remedy));
  if (numbers.size() != count)
    throw InputError(file.string(), "has " + std::to_string(numbers.size()) + " numbers", remedy);
  return numbers;
}

/// A rotation that text has rounded, made exact; nothing if it is none.
std::optional<Eigen::Matrix3d> rotation_near(const Eigen::Matrix3d& matrix) {
  constexpr double kRounding = 1e-2;
  if (!((matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).norm() < kRounding) ||
      matrix.determinant() < 0.0)
    return std::nullopt;
  return Eigen::Quaterniond(matrix).normalized().toRotationMatrix();
}

// --- TUM RGB-D
// ------------------------------------------------------------------------------------

struct StampedImage {
  double time;
  fs::path image;
};
struct StampedPose {
  double time;
  Eigen::Isometry3d T_world_camera;
};

std::vector<StampedImage> read_image_list(const fs::path& file) {
  const char* remedy = "give lines of: timestamp filename";
  std::vector<StampedImage> images;
  for (const Line& line : read_lines(file)) {
    if (line.words.size() < 2) refuse(file, line.number, "names no image", remedy);
    images.push_back({number_in(file, line, 0, remedy), file.parent_path() / line.words[1]});
  }
  return images;
}

std::vector<StampedPose> read_trajectory(const fs::path& file) {
  const char* remedy = "give lines of: timestamp tx ty tz qx qy qz qw";
  std::vector<StampedPose> poses;
  for (const Line& line : read_lines(file)) {
    std::array<double, 8> v;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = number_in(file, line, i, remedy);
    if (!std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); })) continue;
    const Eigen::Quaterniond turn(v[7], v[4], v[5], v[6]);
    if (std::abs(turn.norm() - 1.0) > 1e-2)
      refuse(file, line.number, "has a quaternion of length " + number_text(turn.norm()), remedy);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn.normalized().toRotationMatrix();
    pose.translation() = Point(v[1], v[2], v[3]);
    poses.push_back({v[0], pose});
  }
  return poses;
}

/// For each image the place of the pose nearest in time, each pose once, nearest pairs first.
std::vector<std::optional<std::size_t>> associate(const std::vector<StampedImage>& images,
                                                  const std::vector<StampedPose>& poses,
                                                  double longest_gap) {
  std::multimap<double, std::size_t> by_time;
  for (std::size_t k = 0; k < poses.size(); ++k) by_time.emplace(poses[k].time, k);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < images.size(); ++i)
    for (auto p = by_time.lower_bound(images[i].time - longest_gap);
         p != by_time.end() && p->first <= images[i].time + longest_gap; ++p)
      pairs.emplace_back(std::abs(p->first - images[i].time), i, p->second);
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::optional<std::size_t>> pose_of(images.size());
  std::vector<bool> taken(poses.size(), false);
  for (const auto& [gap, image, pose] : pairs) {
    if (pose_of[image] || taken[pose]) continue;
    pose_of[image] = pose;
    taken[pose] = true;
  }
  return pose_of;
}

DepthSequence open_tum(const fs::path& folder, const SequenceConfig& config) {
  DepthSequence sequence;
  sequence.layout = "tum";
  sequence.units_per_metre = kTumUnits;
  std::vector<StampedImage> images = read_image_list(folder / "depth.txt");
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  const std::vector<StampedPose> poses = read_trajectory(folder / "groundtruth.txt");
  const auto pose_of = associate(images, poses, config.longest_gap);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (pose_of[i])
      sequence.frames.push_back({images[i].image, poses[*pose_of[i]].T_world_camera});
    else
      ++sequence.without_pose;
  }
  return sequence;
}

// --- 7-Scenes and 3DMatch
// -------------------------------------------------------------------------

/// The pose of a file of 4 x 4 numbers; nothing where tracking was lost.
std::optional<Eigen::Isometry3d> read_pose(const fs::path& file) {
  const char* remedy = "give a 4 x 4 matrix, camera to world, with a rotation in it";
  const std::vector<double> v = numbers_of(file, 16, remedy);
  if (!std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); }))
    return std::nullopt;
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
  const auto rotation = rotation_near(matrix.topLeftCorner<3, 3>());
  if (!rotation || matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
    throw InputError(file.string(), "is no pose", remedy);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = *rotation;
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

DepthSequence open_seven_scenes(const fs::path& folder) {
  constexpr std::string_view kEnd = ".depth.png";
  DepthSequence sequence;
  sequence.layout = "7-scenes";
  sequence.units_per_metre = kSevenScenesUnits;
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().ends_with(kEnd)) images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  for (const fs::path& image : images) {
    std::string name = image.filename().string();
    name.replace(name.size() - kEnd.size(), kEnd.size(), ".pose.txt");
    const fs::path pose_file = folder / name;
    const auto pose = fs::exists(pose_file) ? read_pose(pose_file) : std::nullopt;
    if (pose)
      sequence.frames.push_back({image, *pose});
    else
      ++sequence.without_pose;
  }
  return sequence;
}

// --- both
// -----------------------------------------------------------------------------------------

/// fx, fy, cx, cy.
Eigen::Vector4d intrinsics_of(const fs::path& folder, const DepthSequence& sequence,
                              const SequenceConfig& config) {
  if (config.intrinsics) return *config.intrinsics;
  for (const fs::path& file : {folder / kIntrinsicsFile, folder.parent_path() / kIntrinsicsFile}) {
    if (!fs::exists(file)) continue;
    const auto v = numbers_of(file, 9, "give a 3 x 3 matrix: fx 0 cx, 0 fy cy, 0 0 1");
    return {v[0], v[4], v[2], v[5]};
  }
  if (sequence.layout == "tum") return {525.0, 525.0, 319.5, 239.5};
  return {585.0, 585.0, 320.0, 240.0};
}

}  // namespace

DepthSequence open_sequence(const fs::path& folder, const SequenceConfig& config) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string(), "is no folder", "give the folder of a recording");
  const fs::path inner = fs::exists(folder / "data") && !fs::exists(folder / "depth.txt")
                             ? folder / "data"
                             : folder;  // as 3DMatch packs it
  DepthSequence sequence =
      fs::exists(folder / "depth.txt") ? open_tum(folder, config) : open_seven_scenes(inner);
  if (sequence.frames.empty())
    throw InputError(folder.string(),
                     sequence.without_pose > 0 ? "has no image with a pose" : "holds no recording",
                     "give depth.txt, groundtruth.txt and the images (TUM), or frame-*.depth.png "
                     "and frame-*.pose.txt (7-Scenes)");
  const DepthImage first = read_depth_png(sequence.frames.front().image, sequence.units_per_metre);
  const Eigen::Vector4d k = intrinsics_of(inner, sequence, config);
  sequence.camera = {first.width, first.height, k[0], k[1], k[2], k[3]};
  sequence.camera.validate();
  return sequence;
}

DepthImage read_frame(const DepthSequence& sequence, const DepthFrame& frame) {
  DepthImage image = read_depth_png(frame.image, sequence.units_per_metre);
  if (image.width != sequence.camera.width || image.height != sequence.camera.height)
    throw InputError(frame.image.string(),
                     "is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " where the first image is " + std::to_string(sequence.camera.width) +
                         " x " + std::to_string(sequence.camera.height),
                     "give images of one camera");
  return image;
}

SequenceWriter::SequenceWriter(const fs::path& folder, const PinholeCamera& camera)
    : folder_(folder), camera_(camera) {
  camera.validate();
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "run/"
  std::error_code error;
  if (fs::exists(folder_, error) && !(fs::is_directory(folder_, error) && fs::is_empty(folder_)))
    throw InputError(folder_.string(), "exists and is not empty", "give a new folder");
  temporary_ = folder_.parent_path() /
               ("." + folder_.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
  fs::create_directories(temporary_ / "depth", error);
  if (error)
    throw InputError(folder_.string(), "cannot be made: " + error.message(),
                     "choose a folder that you may write to");
}

SequenceWriter::~SequenceWriter() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void SequenceWriter::add(const DepthImage& image, const Eigen::Isometry3d& T_world_camera) {
  std::ostringstream name;
  name << "depth/";
  name.width(6);
  name.fill('0');
  name << count_ << ".png";
  write_depth_png(image, temporary_ / name.str(), kTumUnits);
  const std::string time = number_text(count_ * kFrameSeconds);
  const Eigen::Quaterniond q(T_world_camera.linear());
  const Point& t = T_world_camera.translation();
  images_ += time + " " + name.str() + "\n";
  poses_ += time;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    poses_ += " " + number_text(value);
  poses_ += "\n";
  ++count_;
}

void SequenceWriter::finish() {
  const auto row = [](double a, double b, double c) {
    return number_text(a) + " " + number_text(b) + " " + number_text(c) + "\n";
  };
  const std::string intrinsics =
      row(camera_.fx, 0.0, camera_.cx) + row(0.0, camera_.fy, camera_.cy) + row(0.0, 0.0, 1.0);
  write_text_file(temporary_ / kIntrinsicsFile, intrinsics);
  write_text_file(temporary_ / "depth.txt", images_);
  write_text_file(temporary_ / "groundtruth.txt", poses_);
  std::error_code error;
  fs::rename(temporary_, folder_, error);
  if (error)
    throw InputError(folder_.string(), "cannot be written: " + error.message(),
                     "give a new folder");
  temporary_.clear();
}

}  // namespace ridgeway
