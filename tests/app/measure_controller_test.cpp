// Lengths between clicks, and their file beside the scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/measure_controller.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include <QSignalSpy>
#include <QTest>

#include "core/io/measurements_file.h"
#include "tests/support/qt_application.h"
#include "tests/support/solids.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 20000;
constexpr double kSigma_mm = 0.03;  // of each coordinate of each point

// A grid of points on the plane z = 10, each known to 0.03 mm.
PointCloudPtr grid() {
  auto cloud = std::make_shared<PointCloud>();
  for (int x = 0; x <= 40; ++x) {
    for (int y = 0; y <= 10; ++y) {
      Point& point = cloud->points.emplace_back();
      point.position = {static_cast<double>(x), static_cast<double>(y), 10.0};
      point.covariance = kSigma_mm * kSigma_mm * Eigen::Matrix3d::Identity();
    }
  }
  return cloud;
}

ScenePick pointPick(const PointCloud& cloud, std::size_t index) {
  return {ScenePick::On::kPoint, index, cloud.points[index].position};
}

class MeasureControllerTest : public testing::Test {
 protected:
  void SetUp() override { open(dir_.path()); }
  void open(const std::filesystem::path& folder) {
    MeasuredModel model;
    model.cloud = cloud_;
    model.folder = folder;
    controller_.setModel(model);
    ASSERT_TRUE(waitUntilQuiet());
  }
  bool waitUntilQuiet() {
    return QTest::qWaitFor([&] { return !controller_.busy(); }, kPatience_ms);
  }
  // From the corner of the grid to a point so many columns on.
  void measure(std::size_t columns) {
    controller_.pick(pointPick(*cloud_, 0), nullptr);
    controller_.pick(pointPick(*cloud_, 11 * columns), nullptr);
    ASSERT_TRUE(waitUntilQuiet());
  }
  std::vector<Measurement> kept() const {
    const auto read = readMeasurements(dir_ / "measurements.json");
    EXPECT_TRUE(read.ok()) << read.error().sentence();
    return read.ok() ? *read : std::vector<Measurement>();
  }

  const TempDir dir_;
  const PointCloudPtr cloud_ = grid();
  MeasureController controller_;
};

TEST_F(MeasureControllerTest, GivesTheLengthBetweenTwoClicksAndItsUncertainty) {
  measure(30);
  ASSERT_EQ(controller_.measurements().size(), 1U);
  const Measurement& length = controller_.measurements().front();
  EXPECT_DOUBLE_EQ(length.length_mm, 30.0);
  ASSERT_TRUE(length.points_sigma_mm);
  EXPECT_NEAR(*length.points_sigma_mm, std::sqrt(2.0) * kSigma_mm, 1e-9);
  EXPECT_FALSE(length.date.empty());
  ASSERT_EQ(kept().size(), 1U);
  EXPECT_DOUBLE_EQ(kept().front().length_mm, 30.0);
}

TEST_F(MeasureControllerTest, BeginsAnotherLengthWithTheThirdClick) {
  QSignalSpy lines(&controller_, &MeasureController::linesChanged);
  measure(10);
  controller_.pick(pointPick(*cloud_, 11), nullptr);
  auto drawn = lines.back().front().value<std::vector<SceneLine>>();
  ASSERT_EQ(drawn.size(), 1U);  // the place that was clicked, and no line any more
  EXPECT_EQ(drawn[0].from, drawn[0].to);
  controller_.pick(pointPick(*cloud_, 33), nullptr);
  ASSERT_TRUE(waitUntilQuiet());
  ASSERT_EQ(controller_.measurements().size(), 2U);
  EXPECT_DOUBLE_EQ(controller_.measurements().back().length_mm, 2.0);
  drawn = lines.back().front().value<std::vector<SceneLine>>();
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_TRUE(drawn[0].text.contains("mm"));
}

TEST_F(MeasureControllerTest, ForgetsAClickWithoutASecond) {
  QSignalSpy lines(&controller_, &MeasureController::linesChanged);
  controller_.pick(pointPick(*cloud_, 0), nullptr);
  controller_.forgetBegun();
  EXPECT_TRUE(lines.back().front().value<std::vector<SceneLine>>().empty());
  measure(5);
  ASSERT_EQ(controller_.measurements().size(), 1U);
  EXPECT_DOUBLE_EQ(controller_.measurements().front().length_mm, 5.0);
}

TEST_F(MeasureControllerTest, SaysSoWhenBothClicksAreOnOnePlace) {
  QSignalSpy failed(&controller_, &MeasureController::failed);
  measure(0);
  EXPECT_EQ(failed.count(), 1);
  EXPECT_TRUE(controller_.measurements().empty());
  measure(3);
  EXPECT_EQ(controller_.measurements().size(), 1U);
}

TEST_F(MeasureControllerTest, KnowsNoUncertaintyWhereNoCameraLooked) {
  Mesh plane;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 10), {40, 0, 10}, {0, 10, 10}}) {
    test::addVertex(plane, corner);
  }
  plane.vertices[2].seen = 0;
  plane.triangles = {{0, 1, 2}};
  const auto mesh = std::make_shared<const Mesh>(std::move(plane));
  controller_.pick({ScenePick::On::kTriangle, 0, {1.0, 1.0, 10.0}}, mesh);
  controller_.pick({ScenePick::On::kTriangle, 0, {9.0, 1.0, 10.0}}, mesh);
  ASSERT_TRUE(waitUntilQuiet());
  ASSERT_EQ(controller_.measurements().size(), 1U);
  EXPECT_DOUBLE_EQ(controller_.measurements().front().length_mm, 8.0);
  EXPECT_FALSE(controller_.measurements().front().points_sigma_mm);
}

TEST_F(MeasureControllerTest, KeepsWhatTheCaliperSaidAndTakesLengthsAway) {
  measure(10);
  measure(20);
  controller_.setCaliperMm(0, 10.02);
  ASSERT_TRUE(waitUntilQuiet());
  ASSERT_EQ(kept().size(), 2U);
  ASSERT_TRUE(kept()[0].caliper_mm);
  EXPECT_DOUBLE_EQ(*kept()[0].caliper_mm, 10.02);
  controller_.setCaliperMm(0, 0.0);
  controller_.remove(1);
  ASSERT_TRUE(waitUntilQuiet());
  ASSERT_EQ(kept().size(), 1U);
  EXPECT_FALSE(kept()[0].caliper_mm);
  controller_.remove(7);
  controller_.setCaliperMm(-1, 5.0);
  EXPECT_EQ(controller_.measurements().size(), 1U);
}

TEST_F(MeasureControllerTest, FindsTheLengthsAgainWhenTheScanIsOpenedAgain) {
  measure(10);
  open(dir_ / "other");
  EXPECT_TRUE(controller_.measurements().empty());
  open(dir_.path());
  ASSERT_EQ(controller_.measurements().size(), 1U);
  EXPECT_DOUBLE_EQ(controller_.measurements().front().length_mm, 10.0);
}

TEST_F(MeasureControllerTest, NeverReplacesAFileThatItCannotRead) {
  putFile(dir_ / "measurements.json", "not json");
  QSignalSpy failed(&controller_, &MeasureController::failed);
  open(dir_.path());
  EXPECT_EQ(failed.count(), 1);
  measure(10);
  EXPECT_EQ(controller_.measurements().size(), 1U);
  EXPECT_FALSE(readMeasurements(dir_ / "measurements.json").ok());
}

TEST_F(MeasureControllerTest, KeepsNothingOfASingleFile) {
  open({});
  measure(10);
  EXPECT_EQ(controller_.measurements().size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "measurements.json"));
}

}  // namespace
}  // namespace gyre
