// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/live_reconstruction.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <opencv2/core.hpp>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

constexpr int kViews = 24;
constexpr double kStep_deg = 3.0;

FramePtr shared(Frame frame) { return std::make_shared<const Frame>(std::move(frame)); }

const std::vector<FramePtr>& cylinderViews() {
  static const std::vector<FramePtr> kFrames = [] {
    const test::TurningCylinder world;
    std::vector<FramePtr> frames;
    for (int view = 0; view < kViews; ++view) {
      frames.push_back(shared(world.render(radFromDeg(kStep_deg * view))));
    }
    return frames;
  }();
  return kFrames;
}

FramePtr emptyTable() { return shared(test::TurningCylinder{}.renderEmpty()); }

Reconstruction reconstructAll(const FramePtr& empty_table) {
  auto live = LiveReconstruction::create(test::TurningCylinder{}.calibration(), empty_table);
  for (const FramePtr& frame : cylinderViews()) EXPECT_TRUE(live->addFrame(frame));
  return live->finish({}).value();
}

double medianDistance(const PointCloud& cloud) {
  std::vector<double> distances;
  for (const Point& point : cloud.points) {
    distances.push_back(test::TurningCylinder{}.distanceToSurface(point.position));
  }
  std::sort(distances.begin(), distances.end());
  return distances.empty() ? 1e9 : distances[distances.size() / 2];
}

TEST(LiveReconstruction, MeasuresTheCylinder) {
  const Reconstruction result = reconstructAll(emptyTable());
  EXPECT_GT(result.cloud.points.size(), 300U);
  // 0.1 px in 20 views over 60 degrees at 3.1 px/mm.
  EXPECT_LT(medianDistance(result.cloud), 0.02);
  EXPECT_LT(result.median_px, 0.2);
  EXPECT_GT(result.observations, 5 * result.cloud.points.size());
  EXPECT_FALSE(result.turn_gap) << "72 degrees are no full turn";
  for (const Point& point : result.cloud.points) {
    EXPECT_GT(point.sigmaMm(), 0.0);
    EXPECT_GE(point.views.size(), 3U);
    EXPECT_LT(point.views.back(), static_cast<std::uint32_t>(kViews));
  }
}

// Frames of a table that does not stand where it was told to.
Reconstruction reconstructToldWrong(double scale, double white_deg, const RecoverOptions& recover) {
  ReconstructOptions options;
  options.recover = recover;
  auto live =
      LiveReconstruction::create(test::TurningCylinder{}.calibration(), emptyTable(), options);
  Random random(1);
  for (std::size_t view = 0; view < cylinderViews().size(); ++view) {
    Frame frame = *cylinderViews()[view];
    if (view > 0) {
      frame.table_angle_rad =
          scale * frame.table_angle_rad + radFromDeg(white_deg) * random.gaussian();
    }
    EXPECT_TRUE(live->addFrame(shared(std::move(frame))));
  }
  return live->finish({}).value();
}

double rmsAngleError_deg(const Reconstruction& result) {
  double squares = 0.0;
  for (std::size_t view = 0; view < result.turning->views.size(); ++view) {
    const double truth_rad = radFromDeg(kStep_deg * static_cast<double>(view));
    squares += std::pow(degFromRad(result.turning->views[view].angle_rad - truth_rad), 2) / kViews;
  }
  return std::sqrt(squares);
}

TEST(LiveReconstruction, FindsTheAnglesOfATableThatStandsElsewhereThanTold) {
  RecoverOptions believing;
  believing.angle_freedom_deg = 0.0;
  const Reconstruction told = reconstructToldWrong(1.0, 0.1, believing);
  const Reconstruction solved = reconstructToldWrong(1.0, 0.1, {});
  EXPECT_LT(rmsAngleError_deg(solved), 0.03);
  EXPECT_GT(rmsAngleError_deg(told), 0.07);
  EXPECT_LT(solved.median_px, 0.8 * told.median_px);
  // Believing the motor, sightings are believed less: as many points, but not as good ones.
  EXPECT_GT(solved.cloud.points.size(), told.cloud.points.size() * 95 / 100);
  EXPECT_LT(medianDistance(solved.cloud), medianDistance(told.cloud));
}

TEST(LiveReconstruction, FindsASteadyErrorOfTheSteps) {
  RecoverOptions believing;
  believing.angle_freedom_deg = 0.0;
  const Reconstruction told = reconstructToldWrong(0.99, 0.0, believing);
  const Reconstruction solved = reconstructToldWrong(0.99, 0.0, {});
  EXPECT_GT(rmsAngleError_deg(told), 0.3);
  EXPECT_LT(rmsAngleError_deg(solved), 0.06);
  EXPECT_LT(medianDistance(solved.cloud), 0.03);
}

TEST(LiveReconstruction, NormalsLookOutward) {
  const Reconstruction result = reconstructAll(emptyTable());
  int outward = 0;
  for (const Point& point : result.cloud.points) {
    const Eigen::Vector3d from_axis(point.position.x(), point.position.y(),
                                    point.position.z() > 49 ? 30.0 : 0.0);
    if (point.normal.dot(from_axis) > 0.0) ++outward;
  }
  EXPECT_GT(outward, static_cast<int>(result.cloud.points.size() * 98 / 100));
}

TEST(LiveReconstruction, ManagesWithoutAPictureOfTheBareTable) {
  const Reconstruction result = reconstructAll(nullptr);
  EXPECT_GT(result.cloud.points.size(), 300U);
  EXPECT_LT(medianDistance(result.cloud), 0.1);
}

TEST(LiveReconstruction, GivesTheSamePointsOnOneThreadAsOnMany) {
  const Reconstruction many = reconstructAll(emptyTable());
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Reconstruction single = reconstructAll(emptyTable());
  ASSERT_EQ(many.cloud.points.size(), single.cloud.points.size());
  for (std::size_t i = 0; i < many.cloud.points.size(); ++i) {
    EXPECT_EQ(many.cloud.points[i].position, single.cloud.points[i].position);
    EXPECT_EQ(many.cloud.points[i].views, single.cloud.points[i].views);
  }
}

TEST(LiveReconstruction, ShowsACloudThatGrowsWhileTheTableTurns) {
  auto live = LiveReconstruction::create(test::TurningCylinder{}.calibration(), emptyTable());
  std::vector<std::size_t> sizes;
  for (const FramePtr& frame : cylinderViews()) {
    ASSERT_TRUE(live->addFrame(frame));
    sizes.push_back(live->cloudSoFar()->points.size());
  }
  EXPECT_EQ(sizes.front(), 0U);
  EXPECT_GT(sizes[kViews / 2], 100U);
  EXPECT_GT(sizes.back(), sizes[kViews / 2]);
}

TEST(LiveReconstruction, RefusesAPictureOfAnotherSizeAndGoesOn) {
  auto live = LiveReconstruction::create(test::TurningCylinder{}.calibration(), nullptr);
  Frame small;
  small.name = "small.png";
  small.image_bgr = cv::Mat::zeros(100, 100, CV_8UC3);
  const auto refused = live->addFrame(shared(std::move(small)));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("100 x 100"), std::string::npos);
  EXPECT_TRUE(live->addFrame(cylinderViews().front()));
}

TEST(LiveReconstruction, RefusesAHandHeldCalibrationAndOptionsOutOfRange) {
  Calibration hand_held = test::TurningCylinder{}.calibration();
  hand_held.cam_from_table.reset();
  EXPECT_FALSE(LiveReconstruction::create(hand_held, nullptr));
  ReconstructOptions options;
  options.cloud.max_chi2 = -1.0;
  EXPECT_FALSE(LiveReconstruction::create(test::TurningCylinder{}.calibration(), nullptr, options));
}

TEST(LiveReconstruction, FinishesEmptyWithoutFrames) {
  auto live = LiveReconstruction::create(test::TurningCylinder{}.calibration(), nullptr);
  const auto result = live->finish({});
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->cloud.points.empty());
}

TEST(LiveReconstruction, StopsWhenAsked) {
  auto live = LiveReconstruction::create(test::TurningCylinder{}.calibration(), nullptr);
  ASSERT_TRUE(live->addFrame(cylinderViews().front()));
  std::stop_source stop;
  stop.request_stop();
  const auto result = live->finish(Task(stop.get_token()));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
