// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/x_corner_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/calib/corners/l_corner.h"
#include "tests/support/rendered_checker.h"

namespace gyre {
namespace {

Eigen::Matrix3d affinity(const Eigen::Vector2d& x_axis, const Eigen::Vector2d& y_axis,
                         const Eigen::Vector2d& origin) {
  Eigen::Matrix3d pixel_from_board = Eigen::Matrix3d::Identity();
  pixel_from_board.topLeftCorner<2, 1>() = x_axis;
  pixel_from_board.block<2, 1>(0, 1) = y_axis;
  pixel_from_board.topRightCorner<2, 1>() = origin;
  return pixel_from_board;
}

std::vector<Eigen::Vector2d> innerCorners(const Eigen::Matrix3d& pixel_from_board, int columns,
                                          int rows) {
  std::vector<Eigen::Vector2d> corners;
  for (int row = 1; row < rows; ++row) {
    for (int column = 1; column < columns; ++column) {
      const Eigen::Vector3d homogeneous = pixel_from_board * Eigen::Vector3d(column, row, 1.0);
      corners.push_back(homogeneous.hnormalized());
    }
  }
  return corners;
}

const XCorner* nearest(const std::vector<XCorner>& corners, const Eigen::Vector2d& pixel) {
  const XCorner* best = nullptr;
  for (const XCorner& corner : corners) {
    if (best == nullptr || (corner.pixel - pixel).norm() < (best->pixel - pixel).norm()) {
      best = &corner;
    }
  }
  return best;
}

// Root mean square distance of each true corner to the nearest found one.
double rmsMiss(const std::vector<XCorner>& found, const std::vector<Eigen::Vector2d>& truth) {
  double squares = 0.0;
  for (const Eigen::Vector2d& corner : truth) {
    squares += (nearest(found, corner)->pixel - corner).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(truth.size()));
}

double angleBetweenLines(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized()))));
}

TEST(DetectXCorners, FindsEveryInnerCornerOfABoardAndNothingElse) {
  const Eigen::Matrix3d pixel_from_board = affinity({24, 5}, {-7, 26}, {90.3, 40.7});
  CheckerPicture picture;
  picture.width_px = 340;
  picture.height_px = 300;
  const auto found = detectXCorners(renderPattern(picture, boardPattern(pixel_from_board, 8, 7)));
  const auto truth = innerCorners(pixel_from_board, 8, 7);
  ASSERT_EQ(found.size(), truth.size());
  // Without noise the pixel grid and 8 bits leave about 0.005 px.
  EXPECT_LT(rmsMiss(found, truth), 0.01);
}

TEST(DetectXCorners, KeepsItsErrorUnderNoiseAndPredictsIt) {
  const Eigen::Matrix3d pixel_from_board = affinity({21, 8}, {-6, 24}, {80.4, 35.2});
  const auto truth = innerCorners(pixel_from_board, 10, 9);
  for (const auto& [noise, bound_px] : {std::pair{2.0, 0.035}, std::pair{5.0, 0.05}}) {
    CheckerPicture picture;
    picture.width_px = 360;
    picture.height_px = 360;
    picture.noise = noise;
    const auto found =
        detectXCorners(renderPattern(picture, boardPattern(pixel_from_board, 10, 9)));
    ASSERT_EQ(found.size(), truth.size());
    const double rms_px = rmsMiss(found, truth);
    EXPECT_LT(rms_px, bound_px);
    double squares = 0.0;
    for (const XCorner& corner : found) squares += 2.0 * corner.sigma_px * corner.sigma_px;
    const double predicted_px = std::sqrt(squares / static_cast<double>(found.size()));
    // Of 72 corners the rms is known to 6 %; the rest is the assumed systematic part.
    EXPECT_NEAR(rms_px / predicted_px, 1.0, 0.25);
  }
}

TEST(DetectXCorners, FindsSquaresOfEightPixelsSeenAslant) {
  // 10 px wide and 8 px high, sheared: a board seen aslant at 640 x 480.
  const Eigen::Matrix3d pixel_from_board = affinity({9.5, 2.0}, {-3.0, 7.8}, {60.3, 20.7});
  CheckerPicture picture;
  picture.width_px = 180;
  picture.height_px = 130;
  picture.noise = 2.0;
  const auto found = detectXCorners(renderPattern(picture, boardPattern(pixel_from_board, 10, 8)));
  const auto truth = innerCorners(pixel_from_board, 10, 8);
  ASSERT_EQ(found.size(), truth.size());
  EXPECT_LT(rmsMiss(found, truth), 0.08);
  for (const XCorner& corner : found) EXPECT_LE(corner.clear_radius_px, 10.0);
}

TEST(DetectXCorners, TellsTheEdgesAndWhichSquaresAreBright) {
  const Eigen::Vector2d x_axis(26, 6);
  const Eigen::Vector2d y_axis(3, 25);
  const Eigen::Matrix3d pixel_from_board = affinity(x_axis, y_axis, {40.2, 40.6});
  CheckerPicture picture;
  picture.width_px = picture.height_px = 84;
  const auto found = detectXCorners(renderPattern(picture, checkerPattern(pixel_from_board)));
  const XCorner* corner = nearest(found, {40.2, 40.6});
  ASSERT_NE(corner, nullptr);
  const double a_is_x = angleBetweenLines(corner->edge_a, x_axis);
  const double a_is_y = angleBetweenLines(corner->edge_a, y_axis);
  const auto& other = a_is_x < a_is_y ? y_axis : x_axis;
  EXPECT_LT(std::min(a_is_x, a_is_y), radFromDeg(3.0));
  EXPECT_LT(angleBetweenLines(corner->edge_b, other), radFromDeg(3.0));
  EXPECT_NEAR(corner->edge_a.norm(), 1.0, 1e-12);
  // The square that begins at the origin, along both axes, is bright.
  EXPECT_GT(std::abs((corner->edge_a + corner->edge_b)
                         .normalized()
                         .dot((x_axis.normalized() + y_axis.normalized()).normalized())),
            0.99);
}

TEST(DetectXCorners, SeesThroughDefocusAndLowContrast) {
  const Eigen::Matrix3d pixel_from_board = affinity({24, 5}, {-7, 26}, {90.3, 40.7});
  CheckerPicture picture;
  picture.width_px = 340;
  picture.height_px = 300;
  picture.psf_px = 3.0;
  picture.noise = 2.0;
  const auto truth = innerCorners(pixel_from_board, 8, 7);
  auto found = detectXCorners(renderPattern(picture, boardPattern(pixel_from_board, 8, 7)));
  ASSERT_EQ(found.size(), truth.size());
  EXPECT_LT(rmsMiss(found, truth), 0.1);
  picture.psf_px = 0.8;
  picture.dark = 30.0;
  picture.bright = 60.0;
  found = detectXCorners(renderPattern(picture, boardPattern(pixel_from_board, 8, 7)));
  ASSERT_EQ(found.size(), truth.size());
}

TEST(DetectXCorners, OrdersByStrengthAndHonoursTheLimit) {
  const Eigen::Matrix3d pixel_from_board = affinity({24, 5}, {-7, 26}, {90.3, 40.7});
  CheckerPicture picture;
  picture.width_px = 340;
  picture.height_px = 300;
  picture.noise = 5.0;
  XCornerOptions options;
  options.max_corners = 5;
  const auto found =
      detectXCorners(renderPattern(picture, boardPattern(pixel_from_board, 8, 7)), options);
  ASSERT_EQ(found.size(), 5U);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const XCorner& a, const XCorner& b) {
    return a.strength > b.strength;
  }));
}

TEST(DetectXCorners, FindsNothingInNoiseStripesDotsAndEmptyPictures) {
  EXPECT_TRUE(detectXCorners(cv::Mat()).empty());
  EXPECT_TRUE(detectXCorners(cv::Mat(3, 3, CV_8U, cv::Scalar(7))).empty());
  EXPECT_TRUE(detectXCorners(cv::Mat(200, 200, CV_8U, cv::Scalar(128))).empty());
  CheckerPicture picture;
  picture.width_px = picture.height_px = 200;
  picture.noise = 8.0;
  EXPECT_TRUE(detectXCorners(renderPattern(picture, [](const auto&) { return true; })).empty());
  const auto stripes = [](const Eigen::Vector2d& p) {
    return std::sin(0.3 * p.x() + 0.2 * p.y()) > 0.0;
  };
  EXPECT_TRUE(detectXCorners(renderPattern(picture, stripes)).empty());
  const auto disc = [](const Eigen::Vector2d& p) {
    return (p - Eigen::Vector2d(90, 80)).norm() > 9;
  };
  EXPECT_TRUE(detectXCorners(renderPattern(picture, disc)).empty());
}

TEST(DetectLCorners, FindsTheFourCornersOfASquare) {
  const Eigen::Matrix3d pixel_from_board = affinity({50, 14}, {-12, 52}, {60.3, 40.6});
  CheckerPicture picture;
  picture.width_px = picture.height_px = 160;
  picture.noise = 1.0;
  const auto found = detectLCorners(renderPattern(picture, boardPattern(pixel_from_board, 1, 1)));
  ASSERT_EQ(found.size(), 4U);
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1),
                                        Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(1, 1, 1)}) {
    const Eigen::Vector2d truth_px = (pixel_from_board * corner).hnormalized();
    const auto near = std::find_if(found.begin(), found.end(), [&](const LCorner& candidate) {
      return (candidate.pixel - truth_px).norm() < 0.4;
    });
    ASSERT_NE(near, found.end()) << truth_px.transpose();
    const Eigen::Vector2d middle_px = (pixel_from_board * Eigen::Vector3d(.5, .5, 1)).hnormalized();
    EXPECT_GT(near->inward.dot((middle_px - truth_px).normalized()), 0.9);
  }
}

TEST(DetectLCorners, FindsNothingOnCheckersNoiseAndEmptyPictures) {
  EXPECT_TRUE(detectLCorners(cv::Mat()).empty());
  CheckerPicture picture;
  picture.width_px = picture.height_px = 200;
  picture.noise = 5.0;
  EXPECT_TRUE(detectLCorners(renderPattern(picture, [](const auto&) { return true; })).empty());
}

}  // namespace
}  // namespace gyre
