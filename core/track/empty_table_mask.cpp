// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/empty_table_mask.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
// The turned table's place is computed for one pixel in so many, each way.
constexpr int kMapStep = 8;

cv::Mat toWorkingSize(const cv::Mat& image, double scale) {
  if (scale == 1.0) return image;
  cv::Mat small;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

using Planes = std::array<cv::Mat, 3>;  // by channels

Planes planesOf(const cv::Mat& bgr) {
  Planes planes;
  cv::split(bgr, planes.data());
  return planes;
}

// The same with its outermost pixels twice, all around.
Planes paddedPlanesOf(const cv::Mat& bgr) {
  cv::Mat padded;
  cv::copyMakeBorder(bgr, padded, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  return planesOf(padded);
}

// How far each pixel of a picture is, in the channel that differs most, from that of the nine
// pixels of a padded other one at and around its place that is most like it. Takes the lesser of
// this and what is known already.
void lessenByNearest(const Planes& picture, const Planes& padded, cv::Mat& least) {
  cv::Mat off;
  cv::Mat most_off;
  for (int shift = 0; shift < 9; ++shift) {
    const cv::Rect there(shift % 3, shift / 3, least.cols, least.rows);
    cv::absdiff(picture[0], padded[0](there), most_off);
    for (std::size_t channel = 1; channel < picture.size(); ++channel) {
      cv::absdiff(picture[channel], padded[channel](there), off);
      cv::max(most_off, off, most_off);
    }
    cv::min(least, most_off, least);
  }
}

}  // namespace

EmptyTableMask::EmptyTableMask(const Calibration& calibration, const FramePtr& empty_table)
    : calibration_(calibration), empty_angle_rad_(empty_table->table_angle_rad) {
  GYRE_CHECK(calibration.cam_from_table.has_value());
  const cv::Mat& image = empty_table->image_bgr;
  scale_ = std::min(1.0, static_cast<double>(kWorkingWidth_px) / image.cols);
  empty_bgr_ = toWorkingSize(image, scale_);
  empty_padded_ = paddedPlanesOf(empty_bgr_);
  cv::Mat grey;
  cv::cvtColor(empty_bgr_, grey, cv::COLOR_BGR2GRAY);
  threshold_ = 4.0 + 4.0 * estimateNoiseSigma(grey) + kFlicker * cv::mean(grey)[0];

  const Rigid3 base_from_cam = calibration.cam_from_table->inverse();
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  platter_in_base_.create(empty_bgr_.rows / kMapStep + 2, empty_bgr_.cols / kMapStep + 2, CV_32FC2);
  for (int row = 0; row < platter_in_base_.rows; ++row) {
    auto* line = platter_in_base_.ptr<cv::Vec2f>(row);
    for (int column = 0; column < platter_in_base_.cols; ++column) {
      const Eigen::Vector2d pixel((kMapStep * column + 0.5) / scale_ - 0.5,
                                  (kMapStep * row + 0.5) / scale_ - 0.5);
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
  // Between the nodes the map is as good as straight: cells are a few pixels wide.
  cv::Mat stretched;
  const cv::Matx23d node_from_pixel(1.0 / kMapStep, 0.0, 0.0, 0.0, 1.0 / kMapStep, 0.0);
  cv::warpAffine(map, stretched, node_from_pixel, empty_bgr_.size(),
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  cv::Mat turned;
  cv::remap(empty_bgr_, turned, stretched, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return turned;
}

cv::Mat EmptyTableMask::maskOf(const Frame& frame) const {
  const cv::Mat image = toWorkingSize(frame.image_bgr, scale_);
  const Planes planes = planesOf(image);
  cv::Mat unlike(image.size(), CV_8U, cv::Scalar(255));
  lessenByNearest(planes, empty_padded_, unlike);
  lessenByNearest(planes, paddedPlanesOf(turnedTable(frame.table_angle_rad)), unlike);
  const cv::Mat changed = unlike > threshold_;
  const cv::Mat mask = cleanMask(changed, kHoleShare);
  if (scale_ == 1.0) return mask;
  cv::Mat full;
  cv::resize(mask, full, frame.image_bgr.size(), 0, 0, cv::INTER_LINEAR);
  return full > 127;
}

}  // namespace gyre
