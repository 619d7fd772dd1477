// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/result_folder.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

TEST(ResultFolder, IsMadeWithThoseAboveItAndLeftEmpty) {
  const TempDir dir;
  const fs::path folder = dir.path() / "a" / "b";
  ASSERT_TRUE(makeResultFolder(folder));
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_TRUE(makeResultFolder(folder)) << "a second time";
}

TEST(ResultFolder, CannotBeMadeBelowAFile) {
  const TempDir dir;
  std::ofstream(dir.path() / "file") << "x";
  const auto made = makeResultFolder(dir.path() / "file" / "results");
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, Error::Code::kIo);
  EXPECT_NE(made.error().sentence().find("results"), std::string::npos);
}

TEST(ResultFolder, IsRefusedWhereItsNameIsTooLong) {
  const TempDir dir;
  EXPECT_FALSE(makeResultFolder(dir.path() / std::string(300, 'x')));
}

}  // namespace
}  // namespace gyre
