// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/sharpness.h"

#include <opencv2/imgproc.hpp>

namespace gyre {

double sharpnessOf(const cv::Mat& image_bgr) {
  cv::Mat grey;
  cv::cvtColor(image_bgr, grey, cv::COLOR_BGR2GRAY);
  cv::Mat laplacian;
  cv::Laplacian(grey, laplacian, CV_16S);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(laplacian, mean, deviation);
  return deviation[0] * deviation[0];
}

}  // namespace gyre
