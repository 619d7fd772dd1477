// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/kept_wire_log.h"

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/table_at_port.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr const char* kPort = "/dev/ttyUSB7";

class KeptWireLogTest : public testing::Test {
 protected:
  KeptWireLogTest() {
    setenv("XDG_CACHE_HOME", (dir_ / "cache").c_str(), 1);
    std::filesystem::create_directories(wireLogFile(kPort).parent_path());
    std::filesystem::create_directories(dir_ / "cup");
  }
  void log(const std::string& text, const std::string& ending = "") const {
    putFile(wireLogFile(kPort).string() + ending, text);
  }
  std::string kept() const { return fileText(dir_ / "cup" / kKeptWireLog); }
  bool keptAny() const { return std::filesystem::exists(dir_ / "cup" / kKeptWireLog); }

  TempDir dir_;
};

TEST_F(KeptWireLogTest, HoldsWhatPassedTheOlderPartFirst) {
  log("one\n", ".1");
  log("two\n");
  ASSERT_TRUE(keepWireLog(kPort, dir_ / "cup"));
  EXPECT_EQ(kept(), "one\ntwo\n");
  log("three\n");
  ASSERT_TRUE(keepWireLog(std::string("marlin:") + kPort, dir_ / "cup"));
  EXPECT_EQ(kept(), "one\nthree\n");
}

TEST_F(KeptWireLogTest, HoldsTheLatestWholeLinesUpToItsLimit) {
  log("first line\nsecond\nthird\n");
  for (const std::size_t limit : {5U, 6U, 12U, 13U, 14U, 1000U}) {
    ASSERT_TRUE(keepWireLog(kPort, dir_ / "cup", limit));
    const std::string text = kept();
    EXPECT_LE(text.size(), limit);
    EXPECT_EQ(text, limit < 6     ? ""
                    : limit < 13  ? "third\n"
                    : limit < 100 ? "second\nthird\n"
                                  : "first line\nsecond\nthird\n");
  }
}

TEST_F(KeptWireLogTest, IsNotMadeOfNothing) {
  EXPECT_TRUE(keepWireLog(kPort, dir_ / "cup"));
  EXPECT_TRUE(keepWireLog("sim:duck", dir_ / "cup"));
  EXPECT_TRUE(keepWireLog("hand:36", dir_ / "cup"));
  EXPECT_TRUE(keepWireLog("hand:nonsense", dir_ / "cup"));
  EXPECT_FALSE(keptAny());
}

TEST_F(KeptWireLogTest, SaysWhyItCannotBeWritten) {
  log("one\n");
  const auto kept = keepWireLog(kPort, dir_ / "no such folder");
  ASSERT_FALSE(kept);
  EXPECT_FALSE(kept.error().what.empty());
}

TEST_F(KeptWireLogTest, IsCopiedHoweverTheScanEnds) {
  {
    const WireLogKeeper keeper(kPort, dir_ / "cup");
    log("written meanwhile\n");
    EXPECT_FALSE(keptAny());
  }
  EXPECT_EQ(kept(), "written meanwhile\n");
}

}  // namespace
}  // namespace gyre
