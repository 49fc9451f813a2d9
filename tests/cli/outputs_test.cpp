// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <unistd.h>

#include <filesystem>

#include "program.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

using CliOutputs = Program;

TEST_F(CliOutputs, OneFileByTwoNamesIsOneFile) {
  const std::string map = rooms();
  fs::create_directory(folder_ / "real");
  fs::create_directory_symlink(folder_ / "real", folder_ / "link");
  write_whole(folder_ / "real/old.json", "as it was");
  fs::create_hard_link(folder_ / "real/old.json", folder_ / "hard.json");
  fs::create_symlink("old.json", folder_ / "real/soft.json");
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"a.json", "./a.json"},         {"a.json", path("a.json")},
      {"real/a.json", "link/a.json"}, {"real/../a.json", "a.json"},
      {"real/old.json", "hard.json"}, {"real/old.json", "link/soft.json"}};
  for (const auto& [one, other] : pairs)
    expect_refused({"export", map, "-o", one, "-o", other}, {"twice"});
  fs::current_path(before);
  EXPECT_EQ(read_whole(folder_ / "real/old.json"), "as it was");
}

TEST_F(CliOutputs, NamesThatFitNoOutputAreRefused) {
  const std::string map = rooms(), cloud = two_rooms();
  write_whole(folder_ / "map.bt", "a map");
  expect_refused({"world", "maze", "-o", path("map.bt")}, {"map.bt", ".yaml"});
  std::vector<std::string> build = {"build", cloud, "-o", path("map.bt")};
  for (const std::string& option : room_options()) build.push_back(option);
  expect_refused(build, {"map.bt", ".ridge"});
  expect_refused({"check", map, "--paths", path("map.bt")}, {"map.bt", ".json"});
  write_whole(path("own.json"), "{\"waypoints\": []}\n");
  expect_refused({"check", map, "--paths", path("own.json")}, {"own.json", "there already"});
  expect_refused({"export", map, "--json-graph", path("map.bt")}, {"map.bt", ".json"});
  expect_refused({"export", map, "-o", path("map.bt")}, {"map.bt", ".json"});
  expect_refused(
      {"trajectory", map, "--from", "1,0,1", "--to", "2,0,1", "--picture", path("map.bt")},
      {"map.bt", ".png"});
  EXPECT_EQ(read_whole(folder_ / "map.bt"), "a map");
}

TEST_F(CliOutputs, PathsThatLeadNowhereAreNamedWithTheirReason) {
  const std::string map = rooms();
  fs::create_symlink("circle.ridge", folder_ / "circle.ridge");
  const std::string far(300, 'x');
  expect_refused({"info", path("circle.ridge")}, {"circle.ridge", "circle"});
  expect_refused({"check", path("circle.ridge")}, {"circle.ridge", "circle"});
  expect_refused({"build", path("circle.ridge"), "-o", path("o.ridge")},
                 {"circle.ridge", "circle"});
  expect_refused({"info", path(far)}, {"too long", "shorter name"});
  expect_refused({"export", map, "-o", path(far + ".json")}, {"too long", "shorter name"});
  expect_refused({"simulate", std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml", "-o", path(far)},
                 {"too long", "shorter name"});
  expect_refused({"export", map, "-o", path("rooms.xyz/a.json")}, {"rooms.xyz/a.json", "folder"});
  expect_refused({"info", path("none/map.bt")}, {"none/map.bt", "no such file"});
}

TEST_F(CliOutputs, BytesOfFilesAndNamesAreShownPrintable) {
  const std::string title = "\x1b]0;taken\x07";
  const auto expect_printable = [&](const std::vector<std::string>& arguments) {
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.code, 1);
    for (const char c : refused.err)
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << refused.err;
    EXPECT_NE(refused.err.find(" ("), std::string::npos) << "cut short: " << refused.err;
    EXPECT_LT(refused.err.size(), 2000u);
  };
  expect_printable({"info", path("none" + title)});
  expect_printable({"plan", path("x"), "--radius", title});
  expect_printable({title});
  const std::string nul("\0", 1);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.yaml", "ba" + title + "lls: []\n"},
      {"b.yaml", "boxes: [" + title + "]\n"},
      {"c.pcd", "VERSION .7\nFIELDS x y " + title + nul + "\nSIZE 4 4 4\nTYPE F F F\n"},
      {"d.ply", "ply\nformat " + title + nul + "ascii 1.0\nend_header\n"},
      {"e.xyz", "1 2 3\n1 " + title + nul + " 3\n"},
      {"f.bt", "# Octomap OcTree binary file\nid " + title + nul + "\nres 0.1\ndata\n"},
      {"g.3dmap", "voxel 3 " + title + nul + "\n"},
      {"h.pcd", "VERSION " + std::string(100000, 'v') + "\nDATA ascii\n"}};
  for (const auto& [name, bytes] : files) {
    write_whole(folder_ / name, bytes);
    if (name.ends_with(".yaml"))
      expect_printable({"simulate", path(name), "-o", path("out")});
    else
      expect_printable({"build", path(name), "-o", path("o.ridge"), "--voxel-size", "0.1",
                        "--bounds", "0,0,0,1,1,1"});
  }
  write_whole(folder_ / "queries.csv", "1,0,1,2,0," + title + nul + "\n");
  expect_printable({"plan", rooms(), "--queries", path("queries.csv")});
}

TEST_F(CliOutputs, OneThreadIsEnough) {
  // Nobody else runs as this user, who may have but one thread; root has no such limit. The build
  // folder may be closed to this user (below /root, say), so the program is beside its map.
  const std::string map = rooms();
  fs::permissions(folder_.path(), fs::perms::all);
  fs::copy_file(RIDGEWAY_PROGRAM, folder_ / "ridgeway");
  const std::string user =
      ::geteuid() == 0 ? "setpriv --reuid=54321 --regid=54321 --clear-groups --inh-caps=-all " : "";
  // What looks for leaks at the end of a sanitized program needs a thread.
  const std::string command = "ASAN_OPTIONS=detect_leaks=0 " + user + "prlimit --nproc=1:1 " +
                              path("ridgeway") + " check " + map + " --queries 20 > " +
                              path("stdout") + " 2> " + path("stderr");
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << read_whole(folder_ / "stderr");
  EXPECT_NE(read_whole(folder_ / "stdout").find("clean"), std::string::npos);
}

TEST_F(CliOutputs, AnAnswerThatIsOkHasAPath) {
  const std::string map = rooms();
  for (const char* preference : {"1e308", "1e100", "2e6"})
    expect_refused(
        {"plan", map, "--from", "-2,0,1", "--to", "2,1,1", "--prefer-clearance", preference},
        {"--prefer-clearance"});
  const Outcome planned = run(
      {"plan", map, "--from", "-2,0,1", "--to", "2,1,1", "--prefer-clearance", "1e6", "--json"});
  EXPECT_EQ(planned.code, 0) << planned.err;
  EXPECT_GE(planned.json()["waypoints"].size(), 2u);
}

}  // namespace
}  // namespace ridgeway
