// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/l_corner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/calib/corners/beaudet.h"
#include "core/calib/corners/corner_ring.h"
#include "core/calib/corners/saddle_fit.h"

namespace gyre {
namespace {

// DET of a right angle is largest 1.17 s inside along either edge, where it is 0.0412 contrast^2.
constexpr double kRightAngleGain = 0.0412;
// From the fine maximum the corner lies 2.5 px outwards, more where the angle is sharp.
constexpr double kWalkStep_px = 0.25;
constexpr int kMostSteps = 24;
// The maxima of a right angle are 1.65 px apart, of a sharper one more.
constexpr double kLeastShift_px = 0.3;
constexpr double kMostShift_px = 4.0;

struct Maximum {
  Eigen::Vector2d pixel;
  double response = 0.0;
};

// The top of the quadric through the 3 x 3 pixels around.
Eigen::Vector2d topAround(const cv::Mat& det, const Eigen::Vector2i& peak) {
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(det.at<float>(peak.y() + dy, peak.x() + dx));
  };
  const Eigen::Vector2d slope(0.5 * (at(1, 0) - at(-1, 0)), 0.5 * (at(0, 1) - at(0, -1)));
  const double xy = 0.25 * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1));
  Eigen::Matrix2d hessian;
  hessian << at(1, 0) - 2.0 * at(0, 0) + at(-1, 0), xy, xy, at(0, 1) - 2.0 * at(0, 0) + at(0, -1);
  if (!(hessian.determinant() > 0.0)) return peak.cast<double>();
  const Eigen::Vector2d delta = -hessian.inverse() * slope;
  return peak.cast<double>() + delta.cwiseMax(-0.5).cwiseMin(0.5);
}

std::vector<Maximum> maximaOf(const cv::Mat& det, double least) {
  std::vector<Maximum> maxima;
  for (const ResponsePeak& peak : peaksOf(det, least)) {
    maxima.push_back({topAround(det, peak.pixel), peak.response});
  }
  return maxima;
}

cv::Mat laplacianOf(const cv::Mat& blurred) {
  cv::Mat laplacian;
  cv::Laplacian(blurred, laplacian, CV_32F);
  return laplacian;
}

// Where the Laplacian first changes its sign on the way outwards, or nothing on the whole way.
std::optional<Eigen::Vector2d> walkToCorner(const cv::Mat& laplacian, const Eigen::Vector2d& from,
                                            const Eigen::Vector2d& outward) {
  double before = 0.0;
  for (int step = 0; step <= kMostSteps; ++step) {
    const Eigen::Vector2d place = from + step * kWalkStep_px * outward;
    if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < laplacian.cols - 1 &&
          place.y() < laplacian.rows - 1)) {
      return std::nullopt;
    }
    const double now = brightnessAt(laplacian, place);
    if (before * now < 0.0) {
      const double back_px = kWalkStep_px * now / (now - before);
      return place - back_px * outward;
    }
    before = now;
  }
  return std::nullopt;
}

// The coarse maximum that belongs to a fine one: the nearest further in.
const Maximum* partnerOf(const Maximum& fine, const std::vector<Maximum>& coarse) {
  const Maximum* nearest = nullptr;
  double least_px = kMostShift_px;
  for (const Maximum& candidate : coarse) {
    const double shift_px = (candidate.pixel - fine.pixel).norm();
    if (shift_px < kLeastShift_px || shift_px > least_px) continue;
    least_px = shift_px;
    nearest = &candidate;
  }
  return nearest;
}

}  // namespace

Result<void> LCornerOptions::validate() const {
  if (min_contrast >= 1.0 && min_contrast <= 255.0) return {};
  return Error{Error::Code::kInvalidInput, "The contrast of corners is out of its range.",
               "Use a number from 1 to 255."};
}

std::vector<LCorner> detectLCorners(const cv::Mat& grey, const LCornerOptions& options) {
  GYRE_CHECK(options.validate().ok());
  if (grey.empty()) return {};
  const cv::Mat fine = blurredFurther(blurredForSaddles(grey), kSaddleBlur_px, kFineScale_px);
  const cv::Mat coarse = blurredFurther(fine, kFineScale_px, kCoarseScale_px);
  const double least = kRightAngleGain * options.min_contrast * options.min_contrast;
  const std::vector<Maximum> coarse_maxima = maximaOf(beaudetDet(coarse, kCoarseScale_px), least);
  const cv::Mat laplacian = laplacianOf(fine);

  std::vector<LCorner> corners;
  for (const Maximum& maximum : maximaOf(beaudetDet(fine, kFineScale_px), least)) {
    const Maximum* partner = partnerOf(maximum, coarse_maxima);
    if (partner == nullptr) continue;
    const Eigen::Vector2d inward = (partner->pixel - maximum.pixel).normalized();
    const auto pixel = walkToCorner(laplacian, maximum.pixel, -inward);
    if (!pixel) continue;
    corners.push_back({*pixel, inward, std::sqrt(maximum.response / kRightAngleGain)});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const LCorner& a, const LCorner& b) { return a.strength > b.strength; });
  return corners;
}

}  // namespace gyre
