// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/model_picture.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

constexpr int kSize_px = 200;

Mesh ball() {
  Mesh mesh = test::sphereMesh(10.0, {3, -4, 20});
  for (MeshVertex& vertex : mesh.vertices) vertex.rgb = {200, 40, 40};
  computeNormals(mesh);
  return mesh;
}

// Pixels that are not the paper's.
int painted(const cv::Mat& picture) {
  int count = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (picture.at<cv::Vec3b>(y, x) != cv::Vec3b(255, 255, 255)) ++count;
    }
  }
  return count;
}

TEST(ViewOf, HoldsTheWholeBoxFromEverySide) {
  Bounds bounds;
  bounds.include({-30, -5, 0});
  bounds.include({10, 25, 80});
  for (int azimuth = 0; azimuth < 360; azimuth += 30) {
    for (const double elevation_deg : {-80.0, 0.0, 15.0, 89.0}) {
      const PosedCamera view =
          viewOf(bounds, radFromDeg(azimuth), radFromDeg(elevation_deg), kSize_px);
      EXPECT_TRUE(isRigid(view.cam_from_table, 1e-9));
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d at((corner & 1) != 0 ? bounds.min.x() : bounds.max.x(),
                                 (corner & 2) != 0 ? bounds.min.y() : bounds.max.y(),
                                 (corner & 4) != 0 ? bounds.min.z() : bounds.max.z());
        const auto pixel = view.intrinsics.project(view.cam_from_table * at);
        ASSERT_TRUE(pixel);
        EXPECT_TRUE(view.intrinsics.contains(*pixel));
      }
    }
  }
}

TEST(ViewOf, LooksFromXWithZUp) {
  Bounds bounds;
  bounds.include({-1, -1, -1});
  bounds.include({1, 1, 1});
  const PosedCamera view = viewOf(bounds, 0.0, 0.0, kSize_px);
  EXPECT_GT(view.cam_from_table.inverse().translation.x(), 1.0);
  const auto middle = view.intrinsics.project(view.cam_from_table * Eigen::Vector3d(0, 0, 0));
  const auto above = view.intrinsics.project(view.cam_from_table * Eigen::Vector3d(0, 0, 1));
  const auto left = view.intrinsics.project(view.cam_from_table * Eigen::Vector3d(0, -1, 0));
  EXPECT_NEAR(middle->x(), 0.5 * (kSize_px - 1), 1e-9);
  EXPECT_LT(above->y(), middle->y());
  EXPECT_LT(left->x(), middle->x());  // seen from +x, -y is on the left
}

TEST(PicturesOfSurface, ShowABallAsADisc) {
  const Mesh mesh = ball();
  const PosedCamera view = viewOf(boundsOf(mesh), 0.3, 0.2, kSize_px);
  const cv::Mat picture = picturesOfSurface(mesh, {&view, 1}, SurfacePaint::kColours).front();
  const double distance_mm = (view.cam_from_table * Eigen::Vector3d(3, -4, 20)).norm();
  const double radius_px = view.intrinsics.fx * std::tan(std::asin(10.0 / distance_mm));
  // The rim: one pixel in a hundred.
  EXPECT_NEAR(painted(picture) / (kPi * radius_px * radius_px), 1.0, 0.02);
  const auto middle = picture.at<cv::Vec3b>(kSize_px / 2, kSize_px / 2);
  EXPECT_GT(middle[2], 2 * middle[0]);  // red
}

TEST(PicturesOfSurface, HatchWhatNoCameraSaw) {
  Mesh mesh = ball();
  const PosedCamera view = viewOf(boundsOf(mesh), 0.0, 0.0, kSize_px);
  const cv::Rect middle(80, 80, 40, 40);
  const auto brightest = [&] {
    const cv::Mat picture = picturesOfSurface(mesh, {&view, 1}, SurfacePaint::kColours).front();
    double most = 0.0;
    for (int y = 0; y < middle.height; ++y) {
      for (int x = 0; x < middle.width; ++x) {
        most = std::max<double>(most, picture(middle).at<cv::Vec3b>(y, x)[0]);
      }
    }
    return most;
  };
  EXPECT_LT(brightest(), 60.0);
  for (MeshVertex& vertex : mesh.vertices) vertex.seen = 0;
  EXPECT_GT(brightest(), 150.0);
}

TEST(PicturesOfSurface, ShowColoursOfNumbersNearlyAsTheyAreFromBothSides) {
  Mesh mesh = ball();
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  computeNormals(mesh);
  const PosedCamera view = viewOf(boundsOf(mesh), 0.0, 0.0, kSize_px);
  const cv::Mat picture = picturesOfSurface(mesh, {&view, 1}, SurfacePaint::kFigures).front();
  EXPECT_NEAR(picture.at<cv::Vec3b>(kSize_px / 2, kSize_px / 2)[2], 200, 2);
}

TEST(PicturesOfSurface, AreWhiteWithoutASurface) {
  const PosedCamera view = viewOf({}, 0.0, 0.0, 16);
  EXPECT_EQ(painted(picturesOfSurface({}, {&view, 1}, SurfacePaint::kColours).front()), 0);
}

}  // namespace
}  // namespace gyre
