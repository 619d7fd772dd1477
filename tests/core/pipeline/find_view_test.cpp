// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_view.h"

#include <optional>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

// A textured bar at a place that the view decides, under noise.
cv::Mat picture(int view, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(120, 160, CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const bool bar = u >= 10 + 20 * view && u < 40 + 20 * view && v > 30 && v < 90;
      const double grey = (bar ? 200 : 60) + 2.0 * random.gaussian();
      image.at<cv::Vec3b>(v, u) = cv::Vec3b::all(cv::saturate_cast<uchar>(grey));
    }
  }
  return image;
}

class FindView : public testing::Test {
 protected:
  FindView() {
    Calibration calibration;
    calibration.camera.width_px = 160;
    calibration.camera.height_px = 120;
    calibration.camera.fx = calibration.camera.fy = 300.0;
    calibration.camera.cx = 79.5;
    calibration.camera.cy = 59.5;
    calibration.cam_from_table = Rigid3{};
    ScanSettings settings;
    settings.views = 5;
    store_.emplace(ScanStore::create(folder_.path() / "scan", settings, calibration).value());
  }
  void capture(int view, int shown) {
    Frame frame;
    frame.view = view;
    frame.table_angle_rad = 0.1 * view;
    frame.image_bgr = picture(shown, static_cast<std::uint64_t>(view) + 1);
    ASSERT_TRUE(store_->addView(frame, 10 * view));
  }

  TempDir folder_;
  std::optional<ScanStore> store_;
};

TEST_F(FindView, RecognisesTheViewThroughNoise) {
  for (int view = 0; view < 4; ++view) capture(view, view);
  const auto found = findView(picture(2, 99), *store_, {});
  ASSERT_TRUE(found && *found);
  EXPECT_EQ((*found)->view, 2);
  EXPECT_EQ((*found)->steps, 20);
}

TEST_F(FindView, FindsNothingBetweenTheViews) {
  for (int view = 0; view < 4; ++view) capture(view, view);
  const auto found = findView(picture(5, 99), *store_, {});
  ASSERT_TRUE(found);
  EXPECT_FALSE(*found);
}

TEST_F(FindView, DoesNotGuessWhereTwoViewsLookAlike) {
  capture(0, 1);
  capture(1, 1);
  const auto found = findView(picture(1, 99), *store_, {});
  ASSERT_TRUE(found);
  EXPECT_FALSE(*found);
}

TEST_F(FindView, FindsNothingForAPictureOfAnotherSize) {
  capture(0, 0);
  const auto found = findView(cv::Mat(60, 80, CV_8UC3, cv::Scalar::all(9)), *store_, {});
  ASSERT_TRUE(found);
  EXPECT_FALSE(*found);
}

}  // namespace
}  // namespace gyre
