// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/sightings_file.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

PointSightings sample() {
  return {{{0, {1.5, -0.25}, 0.2}, {199, {1279.0, 959.5}, 0.2}}, {}, {{7, {0.0, 0.0}, 0.2}}};
}

TEST(SightingsFile, GivesBackWhatWasWritten) {
  const TempDir dir;
  ASSERT_TRUE(writeSightings(dir / "sightings.bin", sample()));
  const auto read = readSightings(dir / "sightings.bin", 3);
  ASSERT_TRUE(read) << read.error().sentence();
  ASSERT_EQ(read->size(), 3U);
  ASSERT_EQ(read->at(0).size(), 2U);
  EXPECT_EQ(read->at(0)[1].view, 199);
  EXPECT_EQ(read->at(0)[1].pixel, Eigen::Vector2d(1279.0, 959.5));
  EXPECT_TRUE(read->at(1).empty());
  EXPECT_EQ(sightingsBytes(sample()).size(), 3U * 4 + 3 * 12);
}

TEST(SightingsFile, RefusesWhatIsOfOtherPointsCutOffOrNoNumber) {
  const std::string bytes = sightingsBytes(sample());
  EXPECT_FALSE(parseSightings(bytes, "f", 2));
  EXPECT_FALSE(parseSightings(bytes, "f", 4));
  EXPECT_FALSE(parseSightings(bytes, "f", 1U << 30U));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(parseSightings(bytes.substr(0, length), "f", 3)) << length;
  }
  PointSightings wild = sample();
  wild[2][0].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(parseSightings(sightingsBytes(wild), "f", 3));
  wild = sample();
  wild[2][0].view = -1;
  EXPECT_FALSE(parseSightings(sightingsBytes(wild), "f", 3));
}

}  // namespace
}  // namespace gyre
