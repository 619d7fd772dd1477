// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/free_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

TEST(FreeSpace, IsEnoughForLittleAndTellsBothNumbersForMuch) {
  const TempDir dir;
  EXPECT_TRUE(checkFreeSpace(dir.path(), 1));
  const auto full = checkFreeSpace(dir / "not" / "there yet", std::uintmax_t{1} << 60U);
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, Error::Code::kNoSpace);
  EXPECT_THAT(full.error().what,
              testing::MatchesRegex(".*has .* free; this scan may take .* GB\\."));
}

TEST(FreeSpace, IsThatOfTheDiskOnWhichAFolderWouldBeMade) {
  const TempDir dir;
  const auto here = freeBytesAt(dir.path());
  const auto there = freeBytesAt(dir / "not" / "there yet");
  ASSERT_TRUE(here && there);
  EXPECT_GT(*here, 0U);
  // Others write to the same disk meanwhile.
  EXPECT_NEAR(static_cast<double>(*there), static_cast<double>(*here), 1e9);
}

TEST(FreeSpace, KnowsWhatANoisyPictureTakes) {
  const TempDir dir;
  cv::Mat noise(240, 320, CV_8UC3);
  cv::randn(noise, cv::Scalar::all(110), cv::Scalar::all(7.5));
  ASSERT_TRUE(writePicture(dir / "noise.png", noise));
  const auto more_views = bytesForScan(11, {320, 240}) - bytesForScan(10, {320, 240});
  EXPECT_GE(more_views, std::filesystem::file_size(dir / "noise.png"));
  EXPECT_LT(more_views, noise.total() * noise.elemSize());
}

}  // namespace
}  // namespace gyre
