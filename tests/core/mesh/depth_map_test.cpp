// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/depth_map.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/looking_cameras.h"
#include "tests/support/solids.h"

namespace gyre {
namespace {

TEST(DepthMap, SeesTheNearerSideOfABall) {
  const Mesh ball = test::ballMesh(20.0, 200);
  CameraModel camera = test::plainCamera();
  camera.k1 = 0.0;
  const Rigid3 cam_from_table = test::lookAt({0, 0, 0}, 400.0, 0.5);
  const cv::Mat depth = depthMap(ball, {camera, cam_from_table}, 2);
  ASSERT_EQ(depth.cols, 320);
  ASSERT_EQ(depth.rows, 240);
  int hits = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      // Where the line of sight of the pixel's middle enters the ball.
      const Eigen::Vector3d ray = camera.rayInCam({2.0 * x + 0.5, 2.0 * y + 0.5});
      const Eigen::Vector3d centre(0, 0, 400.0);
      const double along = ray.dot(centre);
      const double inside = along * along - centre.squaredNorm() + 20.0 * 20.0;
      if (inside > 4.0) {
        const double truth = (along - std::sqrt(inside)) * ray.z();
        EXPECT_NEAR(depth.at<float>(y, x), truth, 0.1) << x << " " << y;
        ++hits;
      } else if (inside < -4.0) {
        EXPECT_TRUE(std::isinf(depth.at<float>(y, x)));
      }
    }
  }
  EXPECT_GT(hits, 2000);
}

TEST(DepthMap, LeavesOutWhatIsBehindTheCamera) {
  const Mesh box = test::boxMesh({-10, -10, 500}, {10, 10, 510});
  const cv::Mat depth =
      depthMap(box, {test::plainCamera(), test::lookAt({0, 0, 0}, 400.0, 1.5707)}, 4);
  EXPECT_EQ(std::count_if(depth.begin<float>(), depth.end<float>(),
                          [](float mm) { return std::isfinite(mm); }),
            0);
}

}  // namespace
}  // namespace gyre
