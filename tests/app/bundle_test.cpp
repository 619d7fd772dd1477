// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bundle.h"

#include <cstdlib>
#include <stop_token>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/table_at_port.h"
#include "tests/support/command_answer.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

// The archive's list, by the program that everybody has.
std::string listOf(const std::filesystem::path& archive) {
  const std::string list = archive.string() + ".list";
  const std::string command = "tar -tzf '" + archive.string() + "' > '" + list + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return fileText(list);
}

class BundleTest : public testing::Test {
 protected:
  BundleTest() {
    setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    scan_ = folder_ / "cup";
    std::filesystem::create_directories(scan_ / "frames");
    putFile(scan_ / "cup.gyre", R"({"turntable": "marlin:/dev/ttyUSB7", "camera": "0"})");
    putFile(scan_ / "journal.jsonl", "{}\n");
    putFile(scan_ / "calibration.json", "{}");
    putFile(scan_ / "report.html", "<img>");
    putFile(scan_ / "points.ply", "ply");
    putFile(scan_ / "frames/0001.png", "png");
  }
  TempDir folder_;
  std::filesystem::path scan_;
};

TEST_F(BundleTest, TellsEverythingAndShowsNothing) {
  const auto log = wireLogFile("/dev/ttyUSB7");
  std::filesystem::create_directories(log.parent_path());
  putFile(log, "> M115\\n");
  const auto bundled = writeBundle(scan_, folder_ / "a.tar.gz", BundlePictures::kLeaveOut, Task());
  ASSERT_TRUE(bundled) << bundled.error().sentence();
  EXPECT_EQ(bundled->files, 6U);
  EXPECT_EQ(bundled->pictures, 0U);
  const std::string list = listOf(folder_ / "a.tar.gz");
  for (const char* name :
       {"cup/cup.gyre", "cup/journal.jsonl", "cup/calibration.json", "cup/versions.json",
        "cup/devices.json", "cup/wire/wire-dev-ttyUSB7.log"}) {
    EXPECT_THAT(list, HasSubstr(name));
  }
  EXPECT_THAT(list, Not(HasSubstr("png")));
  EXPECT_THAT(list, Not(HasSubstr("html")));
  EXPECT_THAT(list, Not(HasSubstr("ply")));
}

TEST_F(BundleTest, TakesTheWireLogThatWasKeptWithTheScan) {
  const auto log = wireLogFile("/dev/ttyUSB7");
  std::filesystem::create_directories(log.parent_path());
  putFile(log, "of another scan\n");
  putFile(scan_ / "wire.log", "of this scan\n");
  const auto bundled = writeBundle(scan_, folder_ / "a.tar.gz", BundlePictures::kLeaveOut, Task());
  ASSERT_TRUE(bundled) << bundled.error().sentence();
  EXPECT_EQ(bundled->files, 6U);
  const std::string list = listOf(folder_ / "a.tar.gz");
  EXPECT_THAT(list, HasSubstr("cup/wire.log"));
  EXPECT_THAT(list, Not(HasSubstr("wire-dev")));
}

TEST_F(BundleTest, PicturesComeWhenTheyAreAskedFor) {
  const test::Answer answer =
      test::gyre({"bundle", (scan_ / "cup.gyre").string(), "--with-pictures", "--out",
                  (folder_ / "a.tgz").string()});
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("1 of them pictures"));
  EXPECT_THAT(listOf(folder_ / "a.tgz"), HasSubstr("cup/frames/0001.png"));
  EXPECT_THAT(listOf(folder_ / "a.tgz"), HasSubstr("cup/points.ply"));
}

TEST_F(BundleTest, DamagedSettingsArePackedAllTheSame) {
  putFile(scan_ / "cup.gyre", "{ torn");
  EXPECT_TRUE(writeBundle(scan_, folder_ / "a.zip", BundlePictures::kLeaveOut, Task()));
}

TEST_F(BundleTest, WhatIsNoScanIsTold) {
  std::filesystem::create_directories(folder_ / "nothing");
  for (const char* name : {"none", "nothing"}) {
    const auto bundled =
        writeBundle(folder_ / name, folder_ / "a.zip", BundlePictures::kLeaveOut, Task());
    ASSERT_FALSE(bundled);
    EXPECT_EQ(bundled.error().code, Error::Code::kNotFound);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.zip"));
  }
  EXPECT_EQ(test::gyre({"bundle", scan_.string(), "--out", "a.rar"}).code, 1);
}

TEST_F(BundleTest, StopLeavesNothingBehind) {
  std::stop_source source;
  source.request_stop();
  const auto bundled =
      writeBundle(scan_, folder_ / "a.zip", BundlePictures::kLeaveOut, Task(source.get_token()));
  ASSERT_FALSE(bundled);
  EXPECT_EQ(bundled.error().code, Error::Code::kCancelled);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.zip"));
}

}  // namespace
}  // namespace gyre
