// The live picture is shown whole, with its features where they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/camera_view.h"

#include <gtest/gtest.h>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

FramePtr plainFrame(int width_px, int height_px, const cv::Scalar& bgr) {
  auto frame = std::make_shared<Frame>();
  frame->image_bgr = cv::Mat(height_px, width_px, CV_8UC3, bgr);
  return frame;
}

QImage shown(CameraView& view) { return view.grab().toImage(); }

TEST(CameraView, ShowsTheWholePictureInItsColours) {
  CameraView view;
  view.resize(400, 400);
  view.showFrame(plainFrame(640, 480, {10, 60, 200}));
  const QImage image = shown(view);
  EXPECT_EQ(image.pixelColor(200, 200), QColor(200, 60, 10));
  EXPECT_EQ(image.pixelColor(3, 200), QColor(200, 60, 10));
  EXPECT_EQ(image.pixelColor(200, 55), QColor(200, 60, 10));  // 300 high, from 50 to 350
  EXPECT_NE(image.pixelColor(200, 20), QColor(200, 60, 10));
}

TEST(CameraView, DrawsAMeasuredFeatureOnItsPixel) {
  CameraView view;
  view.resize(640, 480);
  auto tracked = std::make_shared<TrackedFrame>();
  tracked->frame = plainFrame(1280, 960, {0, 0, 0});
  FeatureMark mark;
  mark.state = FeatureState::kMeasured;
  mark.tail = {{200.0F, 400.0F}, {300.0F, 400.0F}};
  tracked->marks.push_back(mark);
  view.showTrackedFrame(tracked);
  const QImage image = shown(view);
  EXPECT_GT(image.pixelColor(150, 200).green(), 200);  // the head
  EXPECT_GT(image.pixelColor(120, 200).green(), 60);   // the tail
  EXPECT_EQ(image.pixelColor(170, 200), QColor(Qt::black));
}

TEST(CameraView, LaysMarksOverEveryPictureUntilTheyAreTakenAway) {
  using Shape = PictureMark::Shape;
  CameraView view;
  view.resize(640, 480);
  const PictureMark cross{Shape::kCross, {200.0F, 400.0F}, {0.0F, 0.0F}};
  const PictureMark arrow{Shape::kArrow, {600.0F, 400.0F}, {700.0F, 400.0F}};
  view.setOverlay({cross, arrow});
  for (int picture = 0; picture < 2; ++picture) {
    view.showFrame(plainFrame(1280, 960, {0, 0, 0}));
    const QImage image = shown(view);
    EXPECT_GT(image.pixelColor(100, 200).red(), 150) << "the middle of the cross";
    EXPECT_EQ(image.pixelColor(107, 200), QColor(Qt::black)) << "beside the cross";
    EXPECT_GT(image.pixelColor(330, 200).blue(), 150) << "along the arrow";
  }
  view.setOverlay({});
  EXPECT_EQ(shown(view).pixelColor(330, 200), QColor(Qt::black));
}

TEST(CameraView, SaysWhyThereIsNoPicture) {
  CameraView view;
  view.resize(300, 200);
  view.showFrame(plainFrame(64, 48, {255, 255, 255}));
  view.clear("No camera yet");
  EXPECT_NE(shown(view).pixelColor(5, 5), QColor(Qt::white));
}

}  // namespace
}  // namespace gyre
