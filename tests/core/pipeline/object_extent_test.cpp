// Outlines of a body of known size give its size; a body that turns out of the picture is told.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/object_extent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/sim/renderer.h"

namespace gyre {
namespace {

constexpr int kViews = 8;

std::vector<SeenOutline> outlinesOf(const RigSettings& rig) {
  const Renderer renderer(rig);
  std::vector<SeenOutline> outlines;
  for (int view = 0; view < kViews; ++view) {
    const int steps = rig.steps_per_turn * view / kViews;
    const auto truth = renderer.truePixels(steps, TableLoad::kObject);
    cv::Mat mask = cv::Mat::zeros(rig.image_height_px, rig.image_width_px, CV_8U);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i].surface == TruePixel::Surface::kObject) mask.data[i] = 255;
    }
    outlines.push_back({kTurn_rad * view / kViews, mask});
  }
  return outlines;
}

RigSettings smallRig(const std::string& object) {
  RigSettings rig = atImageWidth({}, 320);
  rig.image_height_px = 240;
  rig.object = object;
  return rig;
}

TEST(ObjectExtent, TellsSizeAndPlaceOfABody) {
  RigSettings rig = smallRig("duck");
  const Renderer renderer(rig);
  const Bounds bounds = boundsOf(renderer.mesh());
  double reach_mm = 0.0;
  for (const auto& vertex : renderer.mesh().vertices) {
    reach_mm = std::max(reach_mm, static_cast<double>(vertex.position.head<2>().norm()));
  }
  const auto extent = objectExtent(trueCalibration(rig), outlinesOf(rig));
  ASSERT_TRUE(extent.has_value());
  // What outlines leave is larger than the body, and cells are 3 mm wide.
  EXPECT_NEAR(extent->reach_mm, reach_mm, 6.0);
  EXPECT_NEAR(extent->height_mm, bounds.max.z(), 12.0);
  EXPECT_LT(extent->off_axis_mm, 12.0);
  EXPECT_EQ(extent->leaving_share, 0.0);
}

TEST(ObjectExtent, SeesHowFarOffTheAxisABodyStands) {
  RigSettings rig = smallRig("plain");
  rig.object_size_mm = 40.0;
  rig.object_offset_mm = 30.0;
  const auto extent = objectExtent(trueCalibration(rig), outlinesOf(rig));
  ASSERT_TRUE(extent.has_value());
  EXPECT_NEAR(extent->off_axis_mm, 30.0, 5.0);
}

TEST(ObjectExtent, IsNothingWithoutOutlines) {
  const RigSettings rig = smallRig("duck");
  EXPECT_FALSE(objectExtent(trueCalibration(rig), {}).has_value());
  std::vector<SeenOutline> empty = {{0.0, cv::Mat::zeros(240, 320, CV_8U)}};
  EXPECT_FALSE(objectExtent(trueCalibration(rig), empty).has_value());
}

TEST(ObjectExtent, TellsWhatLeavesThePictureBetweenTheViews) {
  const RigSettings rig = smallRig("duck");
  // All that eight views show is taken for object: some of it is out of the picture in between.
  std::vector<SeenOutline> all;
  for (int view = 0; view < kViews; ++view) {
    all.push_back({kTurn_rad * view / kViews, cv::Mat(240, 320, CV_8U, cv::Scalar(255))});
  }
  const auto extent = objectExtent(trueCalibration(rig), all);
  ASSERT_TRUE(extent.has_value());
  EXPECT_GT(extent->leaving_share, 0.05);
}

}  // namespace
}  // namespace gyre
