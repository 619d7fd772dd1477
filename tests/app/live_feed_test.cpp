// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_feed.h"

#include <gtest/gtest.h>

#include "core/sim/renderer.h"

namespace gyre {
namespace {

const Renderer& renderer() {
  static const Renderer kRenderer(atImageWidth(RigSettings{}, 640));
  return kRenderer;
}

FramePtr frameAt(int view) {
  const std::int64_t steps = 16 * view;
  Frame frame = renderer().render(steps, TableLoad::kObject);
  frame.view = view;
  frame.table_angle_rad = 6.283185307179586 * static_cast<double>(steps) / 3200.0;
  return std::make_shared<const Frame>(std::move(frame));
}

LiveReconstruction fresh() {
  auto empty = std::make_shared<const Frame>(renderer().render(0, TableLoad::kEmpty));
  return LiveReconstruction::create(trueCalibration(renderer().rig()), empty).value();
}

TEST(LiveFeed, GivesThePointsThatAReconstructionWithoutThreadsGives) {
  constexpr int kViews = 16;  // more than may wait at once
  LiveReconstruction direct = fresh();
  LiveFeed feed(fresh());
  for (int view = 0; view < kViews; ++view) {
    const FramePtr frame = frameAt(view);
    ASSERT_TRUE(direct.addFrame(frame));
    feed.push(frame);
  }
  const auto expected = direct.finish({});
  const auto points = feed.finish({});
  ASSERT_TRUE(expected);
  ASSERT_TRUE(points);
  ASSERT_GT(points->cloud.points.size(), 50U);
  ASSERT_EQ(points->cloud.points.size(), expected->cloud.points.size());
  for (std::size_t i = 0; i < points->cloud.points.size(); ++i) {
    EXPECT_EQ(points->cloud.points[i].position, expected->cloud.points[i].position);
  }
}

TEST(LiveFeed, TellsAtTheEndWhyAFrameWasRefusedAndNeverBlocksTheScan) {
  LiveFeed feed(fresh());
  Frame wrong;
  wrong.view = 0;
  wrong.image_bgr = cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(0));
  const auto frame = std::make_shared<const Frame>(std::move(wrong));
  for (int i = 0; i < 20; ++i) feed.push(frame);
  const auto points = feed.finish({});
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().code, Error::Code::kInvalidInput);
}

TEST(LiveFeed, EndsAtOnceWhenNobodyWantsItsPoints) {
  LiveFeed feed(fresh());
  for (int view = 0; view < 3; ++view) feed.push(frameAt(view));
}

}  // namespace
}  // namespace gyre
