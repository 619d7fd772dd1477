// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/empty_table_mask.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"
#include "core/track/grey_pyramid.h"
#include "core/track/mask_cleaning.h"

namespace gyre {
namespace {

constexpr int kWorkingWidth_px = 640;
// Lamps flicker: brightness may differ by this share before anything counts as changed.
constexpr double kFlicker = 0.04;
constexpr double kHoleShare = 0.02;

cv::Mat toWorkingSize(const cv::Mat& image, double scale) {
  if (scale == 1.0) return image;
  cv::Mat small;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

// How far a picture leaves, in any channel, the range of the other's values around each pixel.
cv::Mat excessOver(const cv::Mat& image, const cv::Mat& background) {
  const cv::Mat neighbourhood = cv::Mat::ones(3, 3, CV_8U);
  cv::Mat lowest;
  cv::Mat highest;
  cv::erode(background, lowest, neighbourhood);
  cv::dilate(background, highest, neighbourhood);
  cv::Mat above;
  cv::Mat below;
  cv::subtract(image, highest, above);
  cv::subtract(lowest, image, below);
  cv::Mat channels[3];
  cv::split(cv::max(above, below), channels);
  return cv::max(channels[0], cv::max(channels[1], channels[2]));
}

}  // namespace

EmptyTableMask::EmptyTableMask(const Calibration& calibration, const FramePtr& empty_table)
    : calibration_(calibration), empty_angle_rad_(empty_table->table_angle_rad) {
  GYRE_CHECK(calibration.cam_from_table.has_value());
  const cv::Mat& image = empty_table->image_bgr;
  scale_ = std::min(1.0, static_cast<double>(kWorkingWidth_px) / image.cols);
  empty_bgr_ = toWorkingSize(image, scale_);
  cv::Mat grey;
  cv::cvtColor(empty_bgr_, grey, cv::COLOR_BGR2GRAY);
  threshold_ = 4.0 + 4.0 * estimateNoiseSigma(grey) + kFlicker * cv::mean(grey)[0];

  const Rigid3 base_from_cam = calibration.cam_from_table->inverse();
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  platter_in_base_.create(empty_bgr_.size(), CV_32FC2);
  for (int row = 0; row < platter_in_base_.rows; ++row) {
    auto* line = platter_in_base_.ptr<cv::Vec2f>(row);
    for (int column = 0; column < platter_in_base_.cols; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / scale_ - 0.5, (row + 0.5) / scale_ - 0.5);
      const Ray ray{base_from_cam.translation,
                    base_from_cam.rotation * calibration.camera.rayInCam(pixel)};
      const auto point = meetHorizontalPlane(ray, 0.0);
      line[column] = point
                         ? cv::Vec2f(static_cast<float>(point->x()), static_cast<float>(point->y()))
                         : cv::Vec2f(kNothing, kNothing);
    }
  }
}

cv::Mat EmptyTableMask::turnedTable(double table_angle_rad) const {
  // What lies at x in the base at this angle lay at Rz(-(angle - empty angle)) x in the picture.
  const Rigid3 base_now_to_then = baseFromTable(empty_angle_rad_ - table_angle_rad);
  const Rigid3 cam_from_then = *calibration_.cam_from_table * base_now_to_then;
  cv::Mat map(platter_in_base_.size(), CV_32FC2);
  for (int row = 0; row < map.rows; ++row) {
    const auto* from = platter_in_base_.ptr<cv::Vec2f>(row);
    auto* to = map.ptr<cv::Vec2f>(row);
    for (int column = 0; column < map.cols; ++column) {
      to[column] = {-1.0F, -1.0F};
      if (!std::isfinite(from[column][0])) continue;
      const auto pixel = calibration_.camera.project(
          cam_from_then * Eigen::Vector3d(from[column][0], from[column][1], 0.0));
      if (!pixel) continue;
      to[column] = {static_cast<float>((pixel->x() + 0.5) * scale_ - 0.5),
                    static_cast<float>((pixel->y() + 0.5) * scale_ - 0.5)};
    }
  }
  cv::Mat turned;
  cv::remap(empty_bgr_, turned, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return turned;
}

cv::Mat EmptyTableMask::maskOf(const Frame& frame) const {
  const cv::Mat image = toWorkingSize(frame.image_bgr, scale_);
  const cv::Mat unlike_still = excessOver(image, empty_bgr_);
  const cv::Mat unlike_turned = excessOver(image, turnedTable(frame.table_angle_rad));
  const cv::Mat changed = cv::min(unlike_still, unlike_turned) > threshold_;
  const cv::Mat mask = cleanMask(changed, kHoleShare);
  if (scale_ == 1.0) return mask;
  cv::Mat full;
  cv::resize(mask, full, frame.image_bgr.size(), 0, 0, cv::INTER_LINEAR);
  return full > 127;
}

}  // namespace gyre
