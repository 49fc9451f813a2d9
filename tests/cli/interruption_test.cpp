// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "files/atomic_file.hpp"
#include "program.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

struct Signal {
  int number, code;
};
constexpr std::array<Signal, 3> kSignals = {{{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}};

class CliInterruption : public Program {
 protected:
  /// The program, running by itself; its output goes to the files stdout and stderr.
  pid_t start(const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {RIDGEWAY_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = path("stdout"), err = path("stderr");
    const pid_t pid = ::fork();
    if (pid == 0) {
      for (const Signal& signal : kSignals) ::signal(signal.number, SIG_DFL);
      ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
      ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    return pid;
  }

  static int finish(pid_t pid) {
    int status = 0;
    EXPECT_EQ(::waitpid(pid, &status, 0), pid);
    EXPECT_TRUE(WIFEXITED(status)) << "by signal " << WTERMSIG(status);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Waits until there is a temporary file or folder, or the process has ended.
  bool wait_for_temporary(pid_t pid) {
    for (int tries = 0; tries < 20000; ++tries) {
      if (!temporaries().empty()) return true;
      siginfo_t info{};
      if (::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          info.si_pid == pid)
        return false;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }

  /// Files and folders that were meant to go.
  std::vector<std::string> temporaries() const {
    std::vector<std::string> names;
    std::error_code error;  // of entries that go meanwhile
    for (auto entry = fs::directory_iterator(folder_.path(), error);
         !error && entry != fs::directory_iterator(); entry.increment(error))
      if (entry->path().extension() == ".tmp") names.push_back(entry->path().string());
    return names;
  }

  std::string house() { return RIDGEWAY_WORLDS_DIR "/house.yaml"; }
};

TEST_F(CliInterruption, LeavesNothingBehindWheneverItComes) {
  const std::string map = rooms();
  std::string queries;
  for (int i = 0; i < 20000; ++i) queries += "-2,0,1,2,1,1\n";
  write_whole(folder_ / "queries.csv", queries);
  ASSERT_EQ(run({"simulate", house(), "-o", path("run"), "--frames", "20"}).code, 0);
  const std::vector<std::vector<std::string>> commands = {
      {"build", kScan, "-o", path("new.ridge"), "--quiet"},
      {"plan", map, "--queries", path("queries.csv"), "--json"},
      {"trajectory", map, "--from", "-2,0,1", "--to", "2,1,1", "-o", path("new.csv")},
      {"check", map, "--queries", "100000", "--paths", path("new.json")},
      {"export", map, "-o", path("new.ply"), "-o", path("new.png")},
      {"world", "maze", "-o", path("new.yaml")},
      {"simulate", house(), "-o", path("new"), "--frames", "2000"},
      {"fuse", path("run"), "-o", path("new.ridge"), "--voxel-size", "0.05"},
      {"bench", "maze", "--pairs", "5", "--cells", "4", "--long-pairs", "0"},
      {"bench", "hall", "--voxel-sizes", "0.28", "--repeat", "2"}};
  std::mt19937_64 random(18);
  for (int round = 0; round < 4; ++round) {
    for (const auto& command : commands) {
      const pid_t pid = start(command);
      std::this_thread::sleep_for(milliseconds(random() % 400));
      const Signal& signal = kSignals[random() % kSignals.size()];
      ::kill(pid, signal.number);
      int status = 0;
      ASSERT_EQ(::waitpid(pid, &status, 0), pid);
      // It may have been done before the signal came, or have had no handler yet.
      if (WIFSIGNALED(status))
        EXPECT_EQ(WTERMSIG(status), signal.number) << command[0];
      else
        EXPECT_TRUE(WEXITSTATUS(status) == signal.code || WEXITSTATUS(status) == 0)
            << command[0] << " " << WEXITSTATUS(status);
      EXPECT_TRUE(temporaries().empty()) << command[0] << " left " << temporaries().front();
      if (fs::exists(folder_ / "new")) fs::remove_all(folder_ / "new");
    }
  }
}

TEST_F(CliInterruption, FolderThatWasInTheMakingGoes) {
  for (const Signal& signal : kSignals) {
    const pid_t pid = start({"simulate", house(), "-o", path("new"), "--frames", "100000"});
    ASSERT_TRUE(wait_for_temporary(pid));
    std::this_thread::sleep_for(milliseconds(100));
    ::kill(pid, signal.number);
    EXPECT_EQ(finish(pid), signal.code);
    EXPECT_TRUE(temporaries().empty());
    EXPECT_FALSE(exists("new"));
    EXPECT_NE(read_whole(folder_ / "stderr").find("interrupted"), std::string::npos);
  }
}

TEST_F(CliInterruption, SecondSignalEndsAtOnce) {
  const pid_t pid =
      start({"simulate", house(), "-o", path("new"), "--frames", "100000", "--width", "4000"});
  ASSERT_TRUE(wait_for_temporary(pid));
  ::kill(pid, SIGINT);
  std::this_thread::sleep_for(milliseconds(20));
  ::kill(pid, SIGINT);
  EXPECT_EQ(finish(pid), 130);
  EXPECT_TRUE(temporaries().empty());
}

TEST_F(CliInterruption, ResultsSoFarArePrinted) {
  const std::string map = rooms();
  const pid_t pid = start({"check", map, "--queries", "1000000", "--json"});
  std::this_thread::sleep_for(milliseconds(3000));
  ::kill(pid, SIGTERM);
  EXPECT_EQ(finish(pid), 143);
  const Json report = Json::parse(read_whole(folder_ / "stdout"));
  EXPECT_EQ(report["complete"], false);
  EXPECT_EQ(report["disagreements"], 0);
  EXPECT_LT(report["queries"], 1000000);

  const pid_t bench = start({"bench", "maze", "--pairs", "3", "--cells", "3", "--repeat", "10000",
                             "--time-limit", "0.01", "--voxel-size", "0.3", "--json"});
  std::this_thread::sleep_for(milliseconds(4000));
  ::kill(bench, SIGINT);
  EXPECT_EQ(finish(bench), 130);
  const Json table = Json::parse(read_whole(folder_ / "stdout"));
  EXPECT_EQ(table["complete"], false);
  EXPECT_TRUE(table["rows"].is_array());
}

TEST_F(CliInterruption, WhatAKilledRunHasLeftIsRemovedByTheNextOne) {
  for (int i = 0; i < 2; ++i) {
    const pid_t pid = start({"simulate", house(), "-o", path("new"), "--frames", "100000"});
    ASSERT_TRUE(wait_for_temporary(pid));
    std::this_thread::sleep_for(milliseconds(50));
    ::kill(pid, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(pid, &status, 0), pid);
    EXPECT_EQ(temporaries().size(), 1u);
  }
  write_whole(folder_ / ".notes.tmp", "of somebody else");
  EXPECT_EQ(temporaries().size(), 2u);
  const AtomicFile live(folder_ /
                        "live.ridge");  // as every writer, removes what the dead have left
  EXPECT_EQ(temporaries().size(), 2u);
  EXPECT_EQ(run({"world", "maze", "-o", path("maze.yaml")}).code, 0);
  EXPECT_EQ(temporaries().size(), 2u);
  EXPECT_TRUE(exists(".notes.tmp"));
}

TEST_F(CliInterruption, IgnoredSignalsStayIgnored) {
  const Outcome outcome = run({"world", "maze", "-o", path("maze.yaml")}, "> " + path("stdout"));
  EXPECT_EQ(outcome.code, 0);
  const std::string command = "trap '' HUP; exec \"$0\" \"$@\"";
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), RIDGEWAY_PROGRAM, "simulate", house().c_str(),
            "-o", path("new").c_str(), "--frames", "30", "--quiet", nullptr);
    ::_exit(127);
  }
  ASSERT_TRUE(wait_for_temporary(pid));
  ::kill(pid, SIGHUP);
  EXPECT_EQ(finish(pid), 0);
  EXPECT_TRUE(exists("new/depth.txt"));
}

}  // namespace
}  // namespace ridgeway
