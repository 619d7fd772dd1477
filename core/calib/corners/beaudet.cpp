// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/beaudet.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/calib/corners/saddle_fit.h"

namespace gyre {
namespace {

constexpr int kPeakReach = 2;  // 5 x 5 pixels

bool isPeak(const cv::Mat& response, int row, int column) {
  const float here = response.at<float>(row, column);
  for (int r = row - kPeakReach; r <= row + kPeakReach; ++r) {
    const float* line = response.ptr<float>(r);
    for (int c = column - kPeakReach; c <= column + kPeakReach; ++c) {
      const bool earlier = r < row || (r == row && c < column);
      if (line[c] > here || (earlier && line[c] == here)) return false;
    }
  }
  return true;
}

}  // namespace

cv::Mat blurredFurther(const cv::Mat& blurred, double from_px, double to_px) {
  // Gaussians add their variances.
  const double by_px = std::sqrt(to_px * to_px - from_px * from_px);
  cv::Mat further;
  // What a Gaussian holds beyond three of its scales, 0.3 %, is not worth its time.
  const int side_px = 2 * static_cast<int>(std::ceil(3.0 * by_px)) + 1;
  cv::GaussianBlur(blurred, further, {side_px, side_px}, by_px, by_px, cv::BORDER_REPLICATE);
  return further;
}

cv::Mat beaudetDet(const cv::Mat& blurred, double scale_px) {
  const auto gain = static_cast<float>(std::pow(scale_px, 4.0));
  cv::Mat det = cv::Mat::zeros(blurred.size(), CV_32F);
  for (int row = 1; row + 1 < blurred.rows; ++row) {
    const float* above = blurred.ptr<float>(row - 1);
    const float* here = blurred.ptr<float>(row);
    const float* below = blurred.ptr<float>(row + 1);
    float* out = det.ptr<float>(row);
    for (int x = 1; x + 1 < blurred.cols; ++x) {
      const float xx = here[x - 1] - 2.0F * here[x] + here[x + 1];
      const float yy = above[x] - 2.0F * here[x] + below[x];
      const float xy = 0.25F * (above[x - 1] - above[x + 1] - below[x - 1] + below[x + 1]);
      out[x] = gain * (xx * yy - xy * xy);
    }
  }
  return det;
}

cv::Mat saddleResponse(const cv::Mat& blurred) {
  const cv::Mat fine = blurredFurther(blurred, kSaddleBlur_px, kFineScale_px);
  const cv::Mat coarse = blurredFurther(fine, kFineScale_px, kCoarseScale_px);
  cv::Mat response = beaudetDet(fine, kFineScale_px);
  const cv::Mat coarse_det = beaudetDet(coarse, kCoarseScale_px);
  for (int row = 0; row < response.rows; ++row) {
    float* out = response.ptr<float>(row);
    const float* other = coarse_det.ptr<float>(row);
    for (int x = 0; x < response.cols; ++x) {
      out[x] = std::max(0.0F, std::min(-out[x], -other[x]));
    }
  }
  return response;
}

double contrastOfResponse(double response) { return kPi * std::sqrt(std::max(0.0, response)); }

double responseOfContrast(double contrast) {
  const double root = contrast / kPi;
  return root * root;
}

std::vector<ResponsePeak> peaksOf(const cv::Mat& response, double least) {
  std::vector<ResponsePeak> peaks;
  for (int row = kPeakReach; row + kPeakReach < response.rows; ++row) {
    const float* line = response.ptr<float>(row);
    for (int column = kPeakReach; column + kPeakReach < response.cols; ++column) {
      if (!(line[column] > 0.0F && line[column] >= least)) continue;
      if (isPeak(response, row, column)) peaks.push_back({{column, row}, line[column]});
    }
  }
  return peaks;
}

}  // namespace gyre
