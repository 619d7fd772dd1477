// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/printed_panel.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

constexpr double kPixelsPerMm = 10.0;

// Paints the drawing with the centre of the first pixel at (0.5, 0.5) pixels.
cv::Mat painted(const PrintDrawing& drawing, const Eigen::Vector2d& size_mm) {
  cv::Mat page(static_cast<int>(std::lround(size_mm.y() * kPixelsPerMm)),
               static_cast<int>(std::lround(size_mm.x() * kPixelsPerMm)), CV_8U, cv::Scalar(255));
  constexpr int kShift = 8;
  for (const auto ink : {PrintPolygon::Ink::kBlack, PrintPolygon::Ink::kWhite}) {
    for (const PrintPolygon& polygon : drawing.polygons) {
      if (polygon.ink != ink) continue;
      std::vector<cv::Point> outline;
      for (const Eigen::Vector2d& point : polygon.outline) {
        outline.emplace_back(
            static_cast<int>(std::lround((point.x() * kPixelsPerMm - 0.5) * (1 << kShift))),
            static_cast<int>(std::lround((point.y() * kPixelsPerMm - 0.5) * (1 << kShift))));
      }
      cv::fillConvexPoly(page, outline, ink == PrintPolygon::Ink::kBlack ? 0 : 255, cv::LINE_8,
                         kShift);
    }
  }
  return page;
}

// OpenCV's own board of odd rows is the truth of which code stands where.
// OpenCV's own board of odd rows is the truth of which code stands where.
TEST(PrintedPanel, NumbersABoardAsOpenCvDoes) {
  Target target;
  target.dictionary = "DICT_5X5_250";
  PrintDrawing drawing;
  printBoard({7, 5, 10.0, 8.0, 40}, {{35, 25}}, target, drawing);

  const auto codes = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250);
  auto board = cv::aruco::CharucoBoard::create(7, 5, 10.0F, 8.0F, codes);
  for (int& id : board->ids) id += 40;
  cv::Mat drawn;
  // Small: OpenCV's thresholding windows miss codes whose bits are many pixels wide.
  board->draw(cv::Size(360, 280), drawn, 40, 1);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(drawn, codes, corners, ids);
  ASSERT_EQ(ids.size(), target.markers.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto same = std::find_if(target.markers.begin(), target.markers.end(),
                                   [&](const TargetMarker& marker) { return marker.id == ids[i]; });
    ASSERT_NE(same, target.markers.end());
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d& at = same->corners_in_target[k];
      const Eigen::Vector2d on_page(35.0 + at.x(), 25.0 - at.y());
      const Eigen::Vector2d seen(corners[i][k].x / 4.0 - 10.0, corners[i][k].y / 4.0 - 10.0);
      EXPECT_NEAR((seen - on_page).norm(), 0.0, 0.5);  // whole pixels of 0.25 mm
    }
  }
  // The same squares are dark.
  const cv::Mat ours = painted(drawing, {70, 50});
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      const cv::Point rim(column * 100 + 5, row * 100 + 5);
      EXPECT_EQ(ours.at<std::uint8_t>(rim) > 127,
                drawn.at<std::uint8_t>(rim * 0.4 + cv::Point(40, 40)) > 127);
    }
  }
}

TEST(PrintedPanel, PutsCodesWhereTheTargetSaysOnPaperAndInSpace) {
  Target target;
  target.dictionary = "DICT_5X5_250";
  PrintDrawing drawing;
  const Panel panel{{30, 30}, {0, 0, 7}, {0, 1, 0}, {1, 0, 0}};
  printMarker({17, 14.0, {3, -2}, 0.4}, panel, target, drawing);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(painted(drawing, {60, 60}),
                           cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250), corners,
                           ids);
  ASSERT_EQ(ids, std::vector<int>{17});
  ASSERT_EQ(target.markers.size(), 1U);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d in_target = target.markers[0].corners_in_target[i];
    EXPECT_EQ(in_target.z(), 7.0);
    // On this panel the page's right is y and its down is x.
    const Eigen::Vector2d on_page(30.0 + in_target.y(), 30.0 + in_target.x());
    const Eigen::Vector2d seen(corners[0][i].x / kPixelsPerMm, corners[0][i].y / kPixelsPerMm);
    EXPECT_NEAR((seen - on_page).norm(), 0.0, 0.2);
  }
}

TEST(PrintedPanel, ListsInnerCornersRowByRow) {
  Target target;
  PrintDrawing drawing;
  printBoard({4, 3, 5.0}, {{10, 7.5}}, target, drawing);
  ASSERT_EQ(target.corners.size(), 6U);
  EXPECT_EQ(target.faces, (std::vector<std::vector<int>>{{0, 1, 2, 3, 4, 5}}));
  EXPECT_EQ(target.corners[0].position_in_target, Eigen::Vector3d(-5, 2.5, 0));
  EXPECT_EQ(target.corners[5].position_in_target, Eigen::Vector3d(5, -2.5, 0));
  EXPECT_EQ(drawing.polygons.size(), 6U);
}

}  // namespace
}  // namespace gyre
