// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/picture_format.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/mutate.h"

namespace gyre {
namespace {

std::string encoded(const std::string& ending) {
  cv::Mat image(30, 50, CV_8UC3);
  cv::randu(image, 0, 255);
  std::vector<unsigned char> bytes;
  cv::imencode(ending, image, bytes);
  return {bytes.begin(), bytes.end()};
}

class EveryFormat : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(InspectPicture, EveryFormat,
                         testing::Values(".png", ".jpg", ".bmp", ".tif"));

TEST_P(EveryFormat, GivesSizeAndThatTheEndIsThere) {
  const auto header = inspectPicture(encoded(GetParam()));
  ASSERT_TRUE(header);
  EXPECT_EQ(header->width_px, 50);
  EXPECT_EQ(header->height_px, 30);
  EXPECT_TRUE(header->whole);
}

TEST_P(EveryFormat, NeverCallsACutPictureWhole) {
  const std::string bytes = encoded(GetParam());
  // A TIFF may end with its directory, whose last bytes are a link to no next one.
  const std::size_t unneeded = std::string(GetParam()) == ".tif" ? 250 : 0;
  for (std::size_t length = 0; length + unneeded < bytes.size(); ++length) {
    const auto header = inspectPicture(std::string_view(bytes).substr(0, length));
    EXPECT_FALSE(header && header->whole) << length << " of " << bytes.size();
  }
}

TEST_P(EveryFormat, SurvivesDamage) {
  const std::string bytes = encoded(GetParam());
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto header = inspectPicture(mutated(bytes.substr(0, 400), seed));
    EXPECT_TRUE(!header || header->width_px > 0);
  }
}

TEST(InspectPicture, IsNotMisledByAThumbnailOrByWhatFollowsTheEnd) {
  const std::string jpeg = encoded(".jpg");
  const std::string thumbnail = "\xFF\xD9\xFF\xD9";  // an end marker inside a segment
  const std::string segment = std::string("\xFF\xE1\x00\x06", 4) + thumbnail;
  const std::string with_thumbnail = jpeg.substr(0, 2) + segment + jpeg.substr(2);
  EXPECT_TRUE(inspectPicture(with_thumbnail)->whole);
  EXPECT_FALSE(inspectPicture(with_thumbnail.substr(0, with_thumbnail.size() - 2))->whole);
  EXPECT_TRUE(inspectPicture(jpeg + std::string(100, '\0'))->whole);
}

TEST(InspectPicture, GivesNothingForOtherFiles) {
  EXPECT_FALSE(inspectPicture(""));
  EXPECT_FALSE(inspectPicture("GIF89a"));
  EXPECT_FALSE(inspectPicture("<html>not found</html>"));
}

}  // namespace
}  // namespace gyre
