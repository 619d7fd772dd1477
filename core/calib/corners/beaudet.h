// Beaudet's DET: the determinant of the brightness' second derivatives, which marks corners.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

// The two scales at which DET is taken. [px]
inline constexpr double kFineScale_px = 1.5;
inline constexpr double kCoarseScale_px = 2.5;

// The picture (CV_32F), blurred by a Gaussian of one scale, blurred further to a larger one.
cv::Mat blurredFurther(const cv::Mat& blurred, double from_px, double to_px);

// s^4 (Ixx Iyy - Ixy^2) of a picture (CV_32F) blurred to scale s, in squared grey levels: negative
// at X-corners, positive inside L-corners. Zero in the outermost row and column.
// Beaudet, "Rotationally invariant image operators" (1978).
cv::Mat beaudetDet(const cv::Mat& blurred, double scale_px);

// How much of an X-corner there is: the smaller of -DET at both scales, at least 0. A sharp corner
// has the same at all scales, noise loses in the coarse one and small squares in the fine one.
// blurred: the picture at scale 1, from blurredForSaddles().
cv::Mat saddleResponse(const cv::Mat& blurred);

// A sharp X-corner between squares that differ by this many grey levels answers (contrast / pi)^2.
double contrastOfResponse(double response);
double responseOfContrast(double contrast);

struct ResponsePeak {
  Eigen::Vector2i pixel = Eigen::Vector2i::Zero();
  double response = 0.0;
};

// The largest of each 5 x 5 pixels that reach the least response, in the order of the rows. Of
// equals that touch the first one counts.
std::vector<ResponsePeak> peaksOf(const cv::Mat& response, double least);

}  // namespace gyre
