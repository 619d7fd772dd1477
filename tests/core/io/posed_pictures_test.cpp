// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/posed_pictures.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "tests/support/colmap_reader.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr double kNoise_px = 0.3;
constexpr int kViews = 12;
constexpr std::size_t kPoints = 200;

// The pixel by OpenCV, which counts from the centre of the first pixel.
Eigen::Vector2d seenAt(const CameraModel& camera, const Rigid3& pose,
                       const Eigen::Vector3d& place) {
  const Eigen::Vector3d at = pose * place;
  const cv::Matx33d matrix(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> lens = {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{at.x(), at.y(), at.z()}}, cv::Vec3d(), cv::Vec3d(),
                    matrix, lens, pixels);
  return {pixels.front().x, pixels.front().y};
}

PosedPictures sample(double k3 = 0.0) {
  PosedPictures posed;
  posed.cameras = {{1280, 960, 2400.0, 2390.0, 0.0, 650.25, 471.5, -0.08, 0.03, 1e-3, -5e-4, k3}};
  Rigid3 pose;
  pose.rotation << 0, 1, 0, 0.5, 0, -std::sqrt(0.75), -std::sqrt(0.75), 0, -0.5;
  pose.translation = {0, 20, 350};
  for (int view = 0; view < kViews; ++view) {
    posed.pictures.push_back({"view_" + std::to_string(view) + ".png",
                              camFromTable(pose, kTurn_rad * view / kViews),
                              view == 3 ? "view_3.png.png" : ""});
  }
  Random random(5);
  for (std::size_t i = 0; i < kPoints; ++i) {
    Point point;
    point.position = {random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(0, 60)};
    point.rgb = {static_cast<std::uint8_t>(i), 7, 255};
    posed.cloud.points.push_back(point);
    posed.sightings.emplace_back();
    for (int view = 0; view < kViews; ++view) {
      if (random.uniform() < 0.4) continue;
      const Rigid3& at = posed.pictures[static_cast<std::size_t>(view)].cam_from_table;
      const Eigen::Vector2d off(kNoise_px * random.gaussian(), kNoise_px * random.gaussian());
      posed.sightings.back().push_back(
          {view, seenAt(posed.cameras[0], at, point.position) + off, 0.2});
    }
  }
  return posed;
}

// Every point is found where the model says it was seen, by nothing but the files and OpenCV.
void expectReprojects(const PosedPictures& posed, const std::string& lens) {
  const TempDir dir;
  ASSERT_TRUE(writeColmapModel(dir.path(), posed));
  const test::ColmapModel model = test::readColmap(dir.path());
  ASSERT_EQ(model.cameras.size(), 1U);
  const test::ColmapCamera& camera = model.cameras.at(1);
  EXPECT_EQ(camera.model, lens);
  EXPECT_EQ(camera.width, 1280);
  EXPECT_DOUBLE_EQ(camera.parameters[2], 650.75);  // the corner, not the centre, is 0
  ASSERT_EQ(model.images.size(), static_cast<std::size_t>(kViews));
  ASSERT_EQ(model.points.size(), kPoints);
  double squares = 0.0;
  std::size_t count = 0;
  for (const auto& [id, point] : model.points) {
    double sum_px = 0.0;
    for (const auto& [image_id, place] : point.track) {
      const test::ColmapImage& image = model.images.at(image_id);
      ASSERT_LT(place, image.points.size());
      EXPECT_EQ(image.points[place].second, id);
      const cv::Point2d off =
          image.points[place].first - test::projected(camera, image, point.position);
      sum_px += cv::norm(off);
      squares += off.dot(off);
      ++count;
    }
    ASSERT_FALSE(point.track.empty());
    // A rotation vector near half a turn holds six digits.
    EXPECT_NEAR(point.error, sum_px / static_cast<double>(point.track.size()), 1e-5);
  }
  std::size_t seen = 0;
  for (const auto& [id, image] : model.images) seen += image.points.size();
  EXPECT_EQ(seen, count);
  // Two coordinates of the noise put in; 1400 sightings tell it to 2 %.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), kNoise_px * std::sqrt(2.0), 0.03);
}

TEST(ColmapModel, IsReadByItsDocumentationAndReprojects) { expectReprojects(sample(), "OPENCV"); }

TEST(ColmapModel, KeepsTheSixthOrderOfTheLens) { expectReprojects(sample(0.4), "FULL_OPENCV"); }

TEST(ColmapModel, HasNoTracksWhereNobodyKeptTheSightings) {
  const TempDir dir;
  PosedPictures posed = sample();
  posed.sightings.clear();
  ASSERT_TRUE(writeColmapModel(dir.path(), posed));
  const test::ColmapModel model = test::readColmap(dir.path());
  EXPECT_EQ(model.images.size(), static_cast<std::size_t>(kViews));
  EXPECT_EQ(model.points.at(5).error, -1.0);
  EXPECT_TRUE(model.points.at(5).track.empty());
  EXPECT_EQ(model.points.at(5).rgb, cv::Vec3i(4, 7, 255));
}

TEST(ColmapModel, RefusesWhatItCannotHold) {
  const TempDir dir;
  PosedPictures posed = sample();
  posed.cameras[0].skew = 1.0;
  EXPECT_THAT(writeColmapModel(dir.path(), posed).error().what, HasSubstr("skew"));
  EXPECT_FALSE(transformsText(posed));
  posed.cameras[0].skew = 0.1;  // a fiftieth of a pixel at the picture's edge
  posed.pictures[2].name = "my picture.png";
  EXPECT_THAT(writeColmapModel(dir.path(), posed).error().what, HasSubstr("blank"));
  EXPECT_TRUE(transformsText(posed));
}

TEST(TransformsText, PutsTheCameraWhereOpenGlHasIt) {
  const PosedPictures posed = sample();
  const auto text = transformsText(posed);
  ASSERT_TRUE(text);
  const auto root = nlohmann::json::parse(*text);
  EXPECT_EQ(root["unit"], "mm");
  EXPECT_DOUBLE_EQ(root["fl_x"], 2400.0);
  EXPECT_DOUBLE_EQ(root["cx"], 650.75);
  EXPECT_DOUBLE_EQ(root["k1"], -0.08);
  ASSERT_EQ(root["frames"].size(), static_cast<std::size_t>(kViews));
  EXPECT_EQ(root["frames"][3]["mask_path"], "masks/view_3.png.png");
  EXPECT_FALSE(root["frames"][4].contains("mask_path"));
  for (std::size_t view = 0; view < posed.pictures.size(); ++view) {
    const auto& frame = root["frames"][view];
    EXPECT_EQ(frame["file_path"], "images/" + posed.pictures[view].name);
    Eigen::Matrix4d table_from_opengl;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        table_from_opengl(row, column) = frame["transform_matrix"][static_cast<std::size_t>(row)]
                                              [static_cast<std::size_t>(column)];
      }
    }
    EXPECT_NEAR(table_from_opengl.determinant(), 1.0, 1e-9);
    // A pinhole with these axes sees the point at x / -z to the right and y / -z above the middle.
    const Eigen::Vector3d place = posed.cloud.points[view].position;
    const Eigen::Vector4d at = table_from_opengl.inverse() * place.homogeneous();
    CameraModel pinhole = posed.cameras[0];
    pinhole.k1 = pinhole.k2 = pinhole.p1 = pinhole.p2 = 0.0;
    const Eigen::Vector2d pixel = seenAt(pinhole, posed.pictures[view].cam_from_table, place);
    EXPECT_NEAR(root["cx"].get<double>() + 2400.0 * at.x() / -at.z(), pixel.x() + 0.5, 1e-6);
    EXPECT_NEAR(root["cy"].get<double>() - 2390.0 * at.y() / -at.z(), pixel.y() + 0.5, 1e-6);
  }
}

TEST(PosedPictures, MayComeFromSeveralCameras) {
  PosedPictures posed = sample();
  posed.cameras.push_back(posed.cameras[0]);
  posed.cameras[1].fx = 1800.0;
  posed.pictures[7].camera = 1;
  posed.sightings.clear();
  const TempDir dir;
  ASSERT_TRUE(writeColmapModel(dir.path(), posed));
  const test::ColmapModel model = test::readColmap(dir.path());
  ASSERT_EQ(model.cameras.size(), 2U);
  EXPECT_DOUBLE_EQ(model.cameras.at(2).parameters[0], 1800.0);
  EXPECT_EQ(model.images.at(7).camera, 1);
  EXPECT_EQ(model.images.at(8).camera, 2);
  const auto root = nlohmann::json::parse(*transformsText(posed));
  EXPECT_DOUBLE_EQ(root["frames"][6]["fl_x"], 2400.0);
  EXPECT_DOUBLE_EQ(root["frames"][7]["fl_x"], 1800.0);
}

TEST(TransformsText, BringsTheObjectIntoTheUnitCube) {
  const PosedPictures posed = sample();
  const auto root = nlohmann::json::parse(*transformsText(posed));
  Bounds cube;
  for (const Point& point : posed.cloud.points) {
    Eigen::Vector3d at = root["scale"].get<double>() * point.position;
    for (int k = 0; k < 3; ++k) at[k] += root["offset"][static_cast<std::size_t>(k)].get<double>();
    cube.include(at);
  }
  EXPECT_GE(cube.min.minCoeff(), 0.0999);
  EXPECT_LE(cube.max.maxCoeff(), 0.9001);
  EXPECT_FALSE(
      nlohmann::json::parse(*transformsText({posed.cameras, {}, {}, {}})).contains("scale"));
}

}  // namespace
}  // namespace gyre
