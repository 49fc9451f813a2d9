// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/run_program.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <atomic>
#include <cerrno>
#include <thread>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using End = ProgramOutput::End;

ProgramOutput run_shell(const std::string& script, const ProgramLimits& limits,
                        const std::function<bool()>& go_on = {}) {
  return run_program("/bin/sh", {"-c", script}, limits, go_on);
}

std::string text_of(const ProgramOutput& output) {
  return {reinterpret_cast<const char*>(output.bytes.data()), output.bytes.size()};
}

/// Whether this process has no child, running or waiting to be reaped.
bool has_no_child() { return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

TEST(RunProgram, CollectsWhatAProgramWrites) {
  const ProgramOutput output =
      run_shell("echo one; cat; echo two; echo lost >&2", {.seconds = 600});
  EXPECT_EQ(output.end, End::kClosed);
  EXPECT_EQ(text_of(output), "one\ntwo\n");
  EXPECT_EQ(run_shell("head -c 1000000 /dev/zero; exit 3", {.seconds = 600}).bytes.size(),
            1000000u);
  EXPECT_TRUE(run_shell("kill -SEGV $$", {.seconds = 600}).bytes.empty());
  EXPECT_TRUE(has_no_child());
}

TEST(RunProgram, KillsAndReapsAProgramThatHangs) {
  for (const char* script :
       {"exec sleep 1000", "while :; do :; done", "trap '' TERM INT; sleep 1000"})
    EXPECT_EQ(run_shell(script, {.seconds = 0.2}).end, End::kTimedOut) << script;
  // One that has nothing more to say need not be waited for.
  EXPECT_EQ(run_shell("exec >&-; exec sleep 1000", {.seconds = 600}).end, End::kClosed);
  EXPECT_TRUE(has_no_child());
}

TEST(RunProgram, KillsAProgramThatSaysTooMuch) {
  EXPECT_EQ(run_shell("exec yes", {.seconds = 600, .most_bytes = 100'000}).end, End::kTooLong);
  EXPECT_TRUE(has_no_child());
}

TEST(RunProgram, StopsWhenItsCallerDoesNotWantToGoOn) {
  int asked = 0;
  const ProgramOutput output =
      run_shell("exec sleep 1000", {.seconds = 600}, [&] { return ++asked < 3; });
  EXPECT_EQ(output.end, End::kCancelled);
  EXPECT_EQ(asked, 3);
  EXPECT_THROW(run_shell("exec sleep 1000", {.seconds = 600},
                         []() -> bool { throw std::runtime_error("from the caller"); }),
               std::runtime_error);
  EXPECT_TRUE(has_no_child());
}

TEST(RunProgram, ProgramsThatAreNotThereAreNamed) {
  try {
    run_program("/no/such/program", {}, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "/no/such/program");
  }
  EXPECT_TRUE(has_no_child());
}

TEST(RunProgram, ManyThreadsMayRunProgramsAtOnce) {
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&right, t] {
      for (int i = 0; i < 5; ++i) {
        const std::string word = std::to_string(100 * t + i);
        right += text_of(run_shell("echo " + word, {.seconds = 600})) == word + "\n";
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 30);
  EXPECT_TRUE(has_no_child());
}

TEST(RunProgram, AHostThatReapsAllChildrenItselfDoesNoHarm) {
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  const ProgramOutput output = run_shell("echo one", {.seconds = 600});
  const ProgramOutput late = run_shell("exec sleep 1000", {.seconds = 0.1});
  ::signal(SIGCHLD, before);
  EXPECT_EQ(text_of(output), "one\n");
  EXPECT_EQ(late.end, End::kTimedOut);
  EXPECT_TRUE(has_no_child());
}

}  // namespace
}  // namespace ridgeway
