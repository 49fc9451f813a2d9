// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/recordings/scan_sequence.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "files/read_file.hpp"
#include "formats/pcd.hpp"
#include "formats/ply_cloud.hpp"
#include "formats/xyz.hpp"
#include "pose_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const char* const kPoses = "poses.txt";
const char* const kRegistration = "registration_metrics.json";

ScanSequence read_poses(const fs::path& file) {
  const char* remedy = "give lines of: cloud tx ty tz qx qy qz qw";
  ScanSequence sequence;
  sequence.layout = "scans";
  std::set<std::string, std::less<>> names;
  for_each_row(file, [&](const TextRow& row) {
    if (row.words.size() != 8)
      row.refuse("has " + std::to_string(row.words.size()) + " entries in place of 8", remedy);
    const std::string name(row.words[0]);
    if (!names.insert(name).second) row.refuse("names " + name + " again", "give it one pose");
    if (const auto pose = pose_in_row(row, 1, remedy))
      sequence.scans.push_back({file.parent_path() / name, *pose});
    else
      ++sequence.without_pose;
  });
  return sequence;
}

/// Looks values up in JSON; every complaint names the file and the key.
class RegistrationReader {
 public:
  explicit RegistrationReader(const fs::path& file)
      : file_(file), root_(Json::parse(read_file(file), nullptr, false)) {
    if (!root_.is_object()) refuse("", "is no JSON object");
  }

  ScanSequence read() const {
    const std::string reference = text(root_, "reference");
    if (const auto accepted = root_.find("accepted"); accepted != root_.end() && *accepted == false)
      refuse("accepted", "is false: the registration has failed");
    ScanSequence sequence;
    sequence.layout = "registration";
    const Json& scans = member(root_, "scans", "");
    if (!scans.is_object()) refuse("scans", "is no JSON object");
    if (!scans.contains(reference)) refuse("reference", "names no scan");
    for (const auto& [name, scan] : scans.items()) {
      const bool is_reference = name == reference;
      sequence.scans.push_back(
          {file_.parent_path() / (name + "_raw.xyz"),
           is_reference ? Eigen::Isometry3d::Identity() : pose_of(name, scan, reference)});
    }
    return sequence;
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& what) const {
    throw InputError(file_.string() + (key.empty() ? "" : " " + key), what,
                     "register the scans again, or give their poses in " + std::string(kPoses));
  }

  const Json& member(const Json& parent, const std::string& key, const std::string& at) const {
    const std::string path = at.empty() ? key : at + "." + key;
    if (!parent.is_object()) refuse(at, "is no JSON object");
    const auto found = parent.find(key);
    if (found == parent.end()) refuse(path, "is missing");
    return *found;
  }

  std::string text(const Json& parent, const std::string& key) const {
    const Json& value = member(parent, key, "");
    if (!value.is_string()) refuse(key, "is no text");
    return value.get<std::string>();
  }

  Eigen::Isometry3d pose_of(const std::string& name, const Json& scan,
                            std::string reference) const {
    const std::string registration = "registration_to_" + reference, at = "scans." + name;
    std::erase(reference, '_');
    const std::string transform = "transform_source_to_" + reference;
    const std::string key = at + "." + registration + "." + transform;
    const Json& rows = member(member(scan, registration, at), transform, at + "." + registration);
    Eigen::Matrix4d matrix;
    if (!rows.is_array() || rows.size() != 4) refuse(key, "is no 4 x 4 matrix");
    for (std::size_t r = 0; r < 4; ++r) {
      if (!rows[r].is_array() || rows[r].size() != 4) refuse(key, "is no 4 x 4 matrix");
      for (std::size_t c = 0; c < 4; ++c) {
        if (!rows[r][c].is_number()) refuse(key, "has an entry that is no number");
        matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r][c];
      }
    }
    const auto pose = pose_of_matrix(matrix);
    if (!pose) refuse(key, "is no rotation and translation");
    return *pose;
  }

  const fs::path file_;
  const Json root_;
};

void require_clouds(const ScanSequence& sequence, const fs::path& file) {
  constexpr std::size_t kMostNamed = 5;
  std::string missing;
  std::size_t count = 0;
  for (const Scan& scan : sequence.scans)
    if (!is_there(scan.cloud) && ++count <= kMostNamed)
      missing.append(missing.empty() ? "" : ", ").append(scan.cloud.filename().string());
  if (count > kMostNamed)
    missing.append(" and ").append(std::to_string(count - kMostNamed)).append(" more");
  if (count > 0)
    throw InputError(file.string(), "names clouds that are missing: " + missing,
                     "add them to the folder");
}

}  // namespace

bool holds_scans(const fs::path& folder) {
  return is_there(folder / kPoses) || is_there(folder / kRegistration);
}

ScanSequence open_scans(const fs::path& folder) {
  const bool is_list = is_there(folder / kPoses);
  if (!holds_scans(folder))
    throw InputError(folder.string(), "holds no recording of scans",
                     "give a folder with clouds and their poses in " + std::string(kPoses));
  const fs::path file = folder / (is_list ? kPoses : kRegistration);
  ScanSequence sequence = is_list ? read_poses(file) : RegistrationReader(file).read();
  require_clouds(sequence, file);
  if (sequence.scans.empty())
    throw InputError(folder.string(),
                     sequence.without_pose > 0 ? "has no scan with a pose" : "names no scan",
                     "give clouds with poses in " + std::string(kPoses));
  return sequence;
}

PointCloud read_scan(const Scan& scan) {
  const std::string bytes = read_file(scan.cloud), name = scan.cloud.string();
  if (is_pcd(bytes)) return read_pcd(bytes, name);
  if (!is_ply(bytes)) return read_xyz(bytes, name);
  PointCloud cloud = read_ply(bytes, name);
  require_no_faces(cloud, name);
  return cloud;
}

}  // namespace ridgeway
