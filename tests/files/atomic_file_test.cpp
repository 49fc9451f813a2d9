// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "files/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "ridgeway/common/error.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

std::size_t files_in(const TemporaryFolder& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    count += entry.exists();
  }
  return count;
}

TEST(AtomicFile, AppearsWithCommit) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  file.write("hello ");
  file.write("world");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(read_whole(folder / "a.txt"), "hello world");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, LeavesTheOldFileWithoutCommit) {
  const TemporaryFolder folder;
  write_text_file(folder / "a.txt", "old");
  { AtomicFile(folder / "a.txt").write("new"); }
  EXPECT_EQ(read_whole(folder / "a.txt"), "old");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, IsReadByWhomTheOldOneWas) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const auto file = folder / "a.txt";
  write_text_file(file, "old");
  for (const auto mode : {fs::perms::owner_read | fs::perms::owner_write,
                          fs::perms::owner_all | fs::perms::group_read}) {
    fs::permissions(file, mode);
    write_text_file(file, "new");
    EXPECT_EQ(fs::status(file).permissions(), mode);
  }
}

TEST(AtomicFile, ReplacesWhatALinkPointsTo) {
  const TemporaryFolder folder;
  write_text_file(folder / "real.txt", "old");
  std::filesystem::create_symlink(folder / "real.txt", folder / "link.txt");
  write_text_file(folder / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(read_whole(folder / "real.txt"), "new");
}

TEST(AtomicFile, BadTargetsAreRefusedWithTheirPath) {
  const TemporaryFolder folder;
  write_text_file(folder / "file", "x");
  for (const auto& bad : {folder / "none/a.txt", folder / "file/a.txt", folder.path(),
                          std::filesystem::path("/dev/null"), std::filesystem::path()}) {
    try {
      write_text_file(bad, "text");
      ADD_FAILURE() << bad;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), bad.string());
      EXPECT_FALSE(error.remedy().empty());
    }
  }
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, ReasonsAndRemediesFitTheFault) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("circle", folder / "circle");
  write_text_file(folder / "file", "x");
  const auto expect = [](const std::filesystem::path& file, const char* problem,
                         const char* remedy) {
    try {
      write_text_file(file, "text");
      ADD_FAILURE() << file;
    } catch (const InputError& error) {
      EXPECT_NE(error.problem().find(problem), std::string::npos) << error.what();
      EXPECT_NE(error.remedy().find(remedy), std::string::npos) << error.what();
    }
  };
  expect(folder / "circle/a.txt", "symbolic links", "circle");
  expect(folder / std::string(300, 'x'), "too long", "shorter");
  expect(folder / "none/a.txt", "No such file", "create the folder");
  expect(folder / "file/a.txt", "Not a directory", "folder");
}

TEST(AtomicFile, RemovesWhatIsInTheMakingForAHandlerOfSignals) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  file.write("text");
  const Temporary inner(folder / "b", Temporary::Kind::kFolder);
  std::filesystem::create_directories(inner.path() / "c/d");
  write_text_file(inner.path() / "c/d/e.txt", "x");
  EXPECT_EQ(files_in(folder), 2u);
  remove_temporaries();
  EXPECT_EQ(files_in(folder), 0u);
}

TEST(AtomicFile, MovesAFolderWithAllThatIsInIt) {
  const TemporaryFolder folder;
  Temporary made(folder / "run", Temporary::Kind::kFolder);
  ASSERT_EQ(made.error(), 0);
  write_text_file(made.path() / "a.txt", "x");
  EXPECT_EQ(made.move_to(folder / "run"), 0);
  EXPECT_EQ(read_whole(folder / "run/a.txt"), "x");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, AFullDiskLeavesNothingBehind) {
  const TemporaryFolder folder;
  write_text_file(folder / "a.txt", "old");
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_text_file(folder / "a.txt", std::string(5000, 'x')), InputError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_whole(folder / "a.txt"), "old");
  EXPECT_EQ(files_in(folder), 1u);
}

}  // namespace
}  // namespace ridgeway
