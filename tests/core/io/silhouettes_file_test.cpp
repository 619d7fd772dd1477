// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/silhouettes_file.h"

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

Silhouettes twoOutlines() {
  cv::Mat odd = cv::Mat::zeros(5, 13, CV_8U);
  odd.at<std::uint8_t>(2, 12) = 255;
  odd.at<std::uint8_t>(4, 0) = 255;
  cv::Mat even = cv::Mat::zeros(3, 16, CV_8U);
  even.row(1).setTo(255);
  return {{0, odd}, {7, even}};
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.rows == b.rows && a.cols == b.cols &&
         std::equal(a.begin<std::uint8_t>(), a.end<std::uint8_t>(), b.begin<std::uint8_t>());
}

TEST(SilhouettesFile, GivesBackWhatWasWritten) {
  const TempDir folder;
  const auto file = folder / "silhouettes.bin";
  ASSERT_TRUE(writeSilhouettes(file, twoOutlines()));
  const auto read = readSilhouettes(file);
  ASSERT_TRUE(read) << read.error().sentence();
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->at(1).view, 7U);
  EXPECT_TRUE(same(read->at(0).mask, twoOutlines()[0].mask));
  EXPECT_TRUE(same(read->at(1).mask, twoOutlines()[1].mask));
}

TEST(SilhouettesFile, MayHoldNone) {
  const auto read = parseSilhouettes(silhouettesBytes({}), "none");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->empty());
}

TEST(SilhouettesFile, RefusesWhatIsCutOffAnywhere) {
  const std::string bytes = silhouettesBytes(twoOutlines());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(parseSilhouettes(std::string_view(bytes).substr(0, length), "cut")) << length;
  }
  EXPECT_FALSE(parseSilhouettes(bytes + "x", "long"));
}

TEST(SilhouettesFile, RefusesAbsurdSizesAndViewsOutOfOrder) {
  std::string huge = silhouettesBytes(twoOutlines());
  for (std::size_t i = 16; i < 24; ++i) huge[i] = '\x7f';
  EXPECT_FALSE(parseSilhouettes(huge, "huge"));
  Silhouettes twice = twoOutlines();
  twice[1].view = 0;
  EXPECT_FALSE(parseSilhouettes(silhouettesBytes(twice), "twice"));
}

}  // namespace
}  // namespace gyre
