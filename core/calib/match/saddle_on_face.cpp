// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/saddle_on_face.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include "core/calib/corners/plane_homography.h"
#include "core/calib/corners/saddle_fit.h"

namespace gyre {
namespace {

constexpr double kLeastDrawnClear_px = 5.0;  // so that the fit's ring stays inside of it
constexpr int kHalf_px = 18;                 // of the drawing: disc, blur and a poor prediction

// What pixels and blur add to the noise: more, the nearer the next printed edges are. Measured on
// rendered targets. [px]
double systematicSigma_px(double clear_px) {
  constexpr double kPixels_px = 0.008;
  constexpr double kNeighbours_px3 = 0.15;
  return std::hypot(kPixels_px, kNeighbours_px3 / (clear_px * clear_px));
}

}  // namespace

double clearInPicture_px(const SaddleOnFace& corner) {
  return corner.clear_mm *
         leastStretch(homographyJacobian(corner.pixel_from_place, corner.place_mm));
}

std::optional<MeasuredSaddle> measureSaddle(const TargetPicture& picture,
                                            const SaddleOnFace& corner) {
  const Eigen::Matrix2d jacobian = homographyJacobian(corner.pixel_from_place, corner.place_mm);
  const double clear_px = clearInPicture_px(corner);
  if (!(clear_px >= kLeastClear_px) || !jacobian.allFinite()) return std::nullopt;
  // Drawn at least as large as the picture shows the longer way, lest detail be lost.
  const double drawn_clear_px =
      std::max(kLeastDrawnClear_px, corner.clear_mm * jacobian.jacobiSvd().singularValues()[0]);
  const double step_mm = corner.clear_mm / drawn_clear_px;
  const Eigen::Vector2d centre(kHalf_px, kHalf_px);
  const auto pixel_of = [&](const Eigen::Vector2d& drawn) -> Eigen::Vector2d {
    return throughHomography(corner.pixel_from_place, corner.place_mm + step_mm * (drawn - centre));
  };
  constexpr int kSide_px = 2 * kHalf_px + 1;
  cv::Mat map(kSide_px, kSide_px, CV_32FC2);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const Eigen::Vector2d pixel = pixel_of(Eigen::Vector2d(x, y));
      map.at<cv::Vec2f>(y, x) = cv::Vec2f(pixel.cast<float>().eval().data());
    }
  }
  cv::Mat drawn;
  cv::remap(picture.grey, drawn, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  // The same noise spread over more pixels counts for as much more in each.
  const Eigen::Matrix2d pixel_from_drawn = step_mm * jacobian;
  const double noise_grey =
      picture.noise_grey / std::sqrt(std::abs(pixel_from_drawn.determinant()));
  const int radius_px = static_cast<int>(corner.disc * drawn_clear_px);
  const auto fit = fitSaddle(blurredForSaddles(drawn), centre, radius_px, noise_grey);
  if (!fit) return std::nullopt;
  MeasuredSaddle measured;
  measured.pixel = pixel_of(fit->pixel);
  const double margin_px = 2.0;
  if (!(measured.pixel.x() >= margin_px && measured.pixel.y() >= margin_px &&
        measured.pixel.x() <= picture.grey.cols - 1 - margin_px &&
        measured.pixel.y() <= picture.grey.rows - 1 - margin_px)) {
    return std::nullopt;
  }
  const double scale = pixel_from_drawn.norm() / std::sqrt(2.0);
  measured.sigma_px = std::hypot(scale * fit->sigma_px, systematicSigma_px(clear_px));
  return measured;
}

}  // namespace gyre
