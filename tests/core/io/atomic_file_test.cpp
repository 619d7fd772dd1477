// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

std::ptrdiff_t entriesIn(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(WriteFileAtomically, ReplacesTheContentAndLeavesNothingBeside) {
  const TempDir dir;
  const auto file = putFile(dir / "Ölkanne.json", "old and longer");
  ASSERT_TRUE(writeFileAtomically(file, "new"));
  EXPECT_EQ(fileText(file), "new");
  EXPECT_EQ(entriesIn(dir.path()), 1);
}

TEST(WriteFileAtomically, TakesANameOfFullLength) {
  const TempDir dir;
  const auto file = dir / std::string(255, 'n');
  ASSERT_TRUE(writeFileAtomically(file, "x"));
  EXPECT_EQ(fileText(file), "x");
}

TEST(WriteFileAtomically, SaysThatTheFolderIsMissing) {
  const TempDir dir;
  const auto written = writeFileAtomically(dir / "no/such/file", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Error::Code::kNotFound);
}

TEST(WriteFileAtomically, KeepsTheOldFileWhenTheDiskTakesNoMore) {
  const TempDir dir;
  const auto file = putFile(dir / "file", "old");
  // A limit on file sizes stands for the full disk: write() fails half-way.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto written = writeFileAtomically(file, std::string(5000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_FALSE(written);
  EXPECT_EQ(fileText(file), "old");
  EXPECT_EQ(entriesIn(dir.path()), 1);
}

TEST(WriteFileAtomically, LeavesAFolderOfThatNameAlone) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "taken");
  EXPECT_FALSE(writeFileAtomically(dir / "taken", "x"));
  EXPECT_EQ(entriesIn(dir.path()), 1);
}

TEST(RemoveUnfinishedFiles, RemovesOnlyWhatAKilledWriteLeft) {
  const TempDir dir;
  putFile(dir / ".4711-0.gyre-part", "half");
  putFile(dir / ".hidden", "kept");
  putFile(dir / "view.png", "kept");
  removeUnfinishedFiles(dir.path());
  EXPECT_EQ(entriesIn(dir.path()), 2);
  EXPECT_FALSE(std::filesystem::exists(dir / ".4711-0.gyre-part"));
  removeUnfinishedFiles(dir / "not there");
}

}  // namespace
}  // namespace gyre
