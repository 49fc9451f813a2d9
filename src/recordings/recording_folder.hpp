// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <string>

#include "files/temporary.hpp"

namespace ridgeway {

/// A folder that appears whole or not at all, with a folder in it; `target` is where it will stand.
/// Throws InputError where there is something already, or nothing can be written.
std::unique_ptr<Temporary> begin_folder(const std::filesystem::path& folder,
                                        const std::string& inner, std::filesystem::path& target);
/// Moves it to where it is to stand.
void finish_folder(Temporary& temporary, const std::filesystem::path& target);

/// A name with six digits or more.
std::string numbered(const std::string& before, int number, const std::string& after);

/// "tx ty tz qx qy qz qw"
std::string pose_text(const Eigen::Isometry3d& pose);

}  // namespace ridgeway
