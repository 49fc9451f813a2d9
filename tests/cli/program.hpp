// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {

using Json = nlohmann::json;

/// What a run of the program left behind.
struct Outcome {
  int code = -1;
  std::string out, err;

  Json json() const {
    Json value = Json::parse(out, nullptr, false);
    EXPECT_TRUE(value.is_object()) << "stdout is no JSON object: " << out;
    return value;
  }
};

/// Runs the real program, with its folder of files.
class Program : public ::testing::Test {
 protected:
  /// `shell`: put after the command line as it is, such as "| head -1".
  Outcome run(const std::vector<std::string>& arguments, const std::string& shell = "") {
    std::string command = quoted(RIDGEWAY_PROGRAM);
    for (const std::string& argument : arguments) command.append(" ").append(quoted(argument));
    command.append(shell.empty() ? " > " : " ");
    command.append(shell.empty() ? quoted(path("stdout")) : shell);
    command.append(" 2> ").append(quoted(path("stderr")));
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status)) << command;
    Outcome result{WEXITSTATUS(status), {}, read_whole(folder_ / "stderr")};
    if (shell.empty()) result.out = read_whole(folder_ / "stdout");
    std::filesystem::remove(folder_ / "stdout");
    std::filesystem::remove(folder_ / "stderr");
    return result;
  }

  /// The same within this process, for arguments that the program refuses before it does anything:
  /// a hundred times as fast.
  static Outcome run_here(const std::vector<std::string>& arguments) {
    std::vector<const char*> words{"ridgeway"};
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    Outcome result;
    result.code = cli::run(static_cast<int>(words.size()), words.data());
    result.err = ::testing::internal::GetCapturedStderr();
    result.out = ::testing::internal::GetCapturedStdout();
    return result;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  /// How many files there are, hidden ones too.
  std::size_t file_count() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_.path()))
      ++count;
    return count;
  }

  /// Two rooms side by side, each 3 m x 4 m x 2 m, and a door 1.2 m wide in the wall x = 0.
  std::string two_rooms() {
    std::string points = "x y z\n";
    for (int y = -20; y < 20; ++y)
      for (int z = 0; z < 20; ++z)
        if (y < -6 || y >= 6)
          points += "0.05 " + std::to_string(0.1 * y + 0.05) + " " +
                    std::to_string(0.1 * z + 0.05) + "\n";
    write_whole(folder_ / "rooms.xyz", points);
    return path("rooms.xyz");
  }
  static std::vector<std::string> room_options() {
    return {"--voxel-size", "0.1", "--bounds", "-3,-2,0,3,2,2", "--min-clearance", "0.3"};
  }
  Outcome build_rooms(const std::string& name, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"build", two_rooms(), "-o", path(name)};
    for (const std::string& option : room_options()) arguments.push_back(option);
    for (const std::string& option : more) arguments.push_back(option);
    return run(arguments);
  }
  /// The roadmap of the two rooms.
  std::string rooms() {
    const Outcome built = build_rooms("rooms.ridge");
    EXPECT_EQ(built.code, 0) << built.err;
    return path("rooms.ridge");
  }

  /// One line that names what is bad and what to do, on stderr; nothing on stdout; no new file.
  void expect_refused(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& words) {
    expect_refusal([&] { return run(arguments); }, words);
  }
  void expect_refused_here(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& words) {
    expect_refusal([&] { return run_here(arguments); }, words);
  }

  TemporaryFolder folder_;

 private:
  template <typename Run>
  void expect_refusal(const Run& run_it, const std::vector<std::string>& words) {
    const std::size_t files = file_count();
    const Outcome refused = run_it();
    EXPECT_EQ(refused.code, 1);
    EXPECT_EQ(refused.out, "");
    EXPECT_TRUE(refused.err.starts_with("ridgeway: error: ")) << refused.err;
    EXPECT_EQ(refused.err.find('\n'), refused.err.size() - 1) << refused.err;
    EXPECT_NE(refused.err.find(" ("), std::string::npos) << "no remedy: " << refused.err;
    for (const std::string& word : words)
      EXPECT_NE(refused.err.find(word), std::string::npos) << word << " is not in: " << refused.err;
    EXPECT_EQ(file_count(), files);
  }

  static std::string quoted(const std::string& text) {
    std::string result(1, '\'');
    for (const char c : text)
      if (c == '\'')
        result.append("'\\''");
      else
        result.push_back(c);
    return result.append(1, '\'');
  }
};

inline const std::string kScan = std::string(RIDGEWAY_DATA_DIR) + "/fr_079.bt";

}  // namespace ridgeway
