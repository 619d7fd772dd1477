// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/visibility_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/model_samples.h"
#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

PointCloud withoutViews() {
  PointCloud cloud = sampleCloud();
  for (Point& point : cloud.points) point.views.clear();
  return cloud;
}

TEST(WriteVisibility, GivesBackTheViewsOfEachPoint) {
  const TempDir dir;
  ASSERT_TRUE(writeVisibility(dir / "visibility.bin", sampleCloud()));
  PointCloud cloud = withoutViews();
  ASSERT_TRUE(readVisibility(dir / "visibility.bin", cloud));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_EQ(cloud.points[i].views, sampleCloud().points[i].views);
  }
}

TEST(VisibilityBytes, AreLittleEndianWordsWithTheirCountAhead) {
  PointCloud cloud;
  cloud.points.resize(2);
  cloud.points[1].views = {0x01020304};
  EXPECT_EQ(visibilityBytes(cloud), std::string("\0\0\0\0\1\0\0\0\4\3\2\1", 12));
}

TEST(ReadVisibility, RefusesAFileOfOtherPointsAndKeepsTheCloud) {
  const std::string bytes = visibilityBytes(sampleCloud());
  PointCloud cloud = sampleCloud();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(parseVisibility(bytes.substr(0, length), "f", cloud));
  }
  EXPECT_FALSE(parseVisibility(bytes + '\0', "f", cloud));
  EXPECT_FALSE(parseVisibility(std::string(12, '\xFF'), "f", cloud));
  EXPECT_EQ(cloud.points[2].views, sampleCloud().points[2].views);
  EXPECT_EQ(readVisibility("/nowhere/visibility.bin", cloud).error().code, Error::Code::kNotFound);
}

TEST(ParseVisibility, SurvivesDamage) {
  const std::string bytes = visibilityBytes(sampleCloud());
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    PointCloud cloud = withoutViews();
    const auto parsed = parseVisibility(mutated(bytes, seed), "f", cloud);
    EXPECT_TRUE(parsed || !parsed.error().what.empty());
  }
}

}  // namespace
}  // namespace gyre
