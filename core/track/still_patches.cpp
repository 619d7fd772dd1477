// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/still_patches.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

constexpr double kWorkingWidth_px = 640.0;
constexpr int kColumns = 16;
constexpr int kRows = 12;
constexpr int kHalf = 10;  // of a piece: 21 x 21
constexpr int kSide = 2 * kHalf + 1;
constexpr int kPixels = kSide * kSide;
constexpr int kMargin = kHalf + 3;

constexpr double kLeastContrast = 4.0;    // texture over noise
constexpr double kMostPlaceSigma = 0.05;  // working px that noise may shift a piece by
constexpr double kLeastCorrelation = 0.8;
constexpr int kSteps = 12;
constexpr double kReach = 3.5;     // working px from where a search began
constexpr double kArrived = 0.01;  // working px

constexpr double kCoarse = 0.5;  // of the working picture
constexpr int kCoarseReach = 32;

// Immerkaer, "Fast noise variance estimation" (1996): what a mask that is blind to slopes and to
// even bending leaves.
double noiseOf(const cv::Mat& grey) {
  const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::Mat left;
  cv::filter2D(grey, left, CV_32F, kernel);
  std::vector<float> sizes(left.begin<float>(), left.end<float>());
  for (float& size : sizes) size = std::abs(size);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  // The mask's coefficients have the norm 6; a median is 0.6745 sigma.
  return std::max(0.3, static_cast<double>(*middle) / (6.0 * 0.6745));
}

// The values about a centre, bilinear, less their mean and over their root mean square. False when
// they leave the picture or are all the same.
bool sample(const cv::Mat& grey, const Eigen::Vector2d& centre, cv::Mat& out) {
  const int x0 = static_cast<int>(std::floor(centre.x())) - kHalf;
  const int y0 = static_cast<int>(std::floor(centre.y())) - kHalf;
  if (x0 < 0 || y0 < 0 || x0 + kSide >= grey.cols || y0 + kSide >= grey.rows) return false;
  const auto fx = static_cast<float>(centre.x() - std::floor(centre.x()));
  const auto fy = static_cast<float>(centre.y() - std::floor(centre.y()));
  float sum = 0.0F;
  for (int y = 0; y < kSide; ++y) {
    const float* above = grey.ptr<float>(y0 + y) + x0;
    const float* below = grey.ptr<float>(y0 + y + 1) + x0;
    float* row = out.ptr<float>(y);
    for (int x = 0; x < kSide; ++x) {
      const float upper = above[x] + fx * (above[x + 1] - above[x]);
      const float lower = below[x] + fx * (below[x + 1] - below[x]);
      row[x] = upper + fy * (lower - upper);
      sum += row[x];
    }
  }
  const float mean = sum / static_cast<float>(kPixels);
  float squares = 0.0F;
  float* values = out.ptr<float>();
  for (int i = 0; i < kPixels; ++i) {
    values[i] -= mean;
    squares += values[i] * values[i];
  }
  if (!(squares > 1e-3F)) return false;
  const float scale = std::sqrt(static_cast<float>(kPixels) / squares);
  for (int i = 0; i < kPixels; ++i) values[i] *= scale;
  return true;
}

cv::Mat emptyPatch() { return cv::Mat::zeros(kSide, kSide, CV_32F); }

}  // namespace

StillPatches::StillPatches(const cv::Mat& reference_bgr)
    : scale_(std::min(1.0, kWorkingWidth_px / reference_bgr.cols)),
      size_px_(reference_bgr.cols, reference_bgr.rows) {
  const cv::Mat grey = workingGrey(reference_bgr);
  working_middle_ = {0.5 * (grey.cols - 1), 0.5 * (grey.rows - 1)};
  const double noise = noiseOf(grey);
  cv::Mat goodness;
  cv::cornerMinEigenVal(grey, goodness, kHalf, 3);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const cv::Rect inside(kMargin, kMargin, grey.cols - 2 * kMargin, grey.rows - 2 * kMargin);
      const int left = grey.cols * column / kColumns;
      const int top = grey.rows * row / kRows;
      const cv::Rect cell = cv::Rect(left, top, grey.cols * (column + 1) / kColumns - left,
                                     grey.rows * (row + 1) / kRows - top) &
                            inside;
      if (cell.empty()) continue;
      cv::Point best;
      cv::minMaxLoc(goodness(cell), nullptr, nullptr, nullptr, &best);
      if (auto patch = patchAt(grey, best + cell.tl(), noise)) {
        patches_.push_back(std::move(*patch));
      }
    }
  }
}

cv::Mat StillPatches::workingGrey(const cv::Mat& image_bgr) const {
  cv::Mat small;
  cv::resize(image_bgr, small, {}, scale_, scale_, cv::INTER_AREA);
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  cv::Mat exact;
  grey.convertTo(exact, CV_32F);
  return exact;
}

std::optional<StillPatches::Patch> StillPatches::patchAt(const cv::Mat& grey,
                                                         const cv::Point& centre,
                                                         double noise) const {
  Patch patch;
  patch.centre = {centre.x, centre.y};
  patch.normalized = emptyPatch();
  if (!sample(grey, patch.centre, patch.normalized)) return std::nullopt;
  cv::Scalar mean;
  cv::Scalar contrast;
  cv::meanStdDev(grey(cv::Rect(centre.x - kHalf, centre.y - kHalf, kSide, kSide)), mean, contrast);
  if (contrast[0] < kLeastContrast * noise) return std::nullopt;
  // Slopes from the picture itself: at a piece's rim its own values have no neighbours.
  patch.gradient_x = emptyPatch();
  patch.gradient_y = emptyPatch();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int px = centre.x - kHalf + x;
      const int py = centre.y - kHalf + y;
      const double gx = 0.5 * (grey.at<float>(py, px + 1) - grey.at<float>(py, px - 1));
      const double gy = 0.5 * (grey.at<float>(py + 1, px) - grey.at<float>(py - 1, px));
      patch.gradient_x.at<float>(y, x) = static_cast<float>(gx / contrast[0]);
      patch.gradient_y.at<float>(y, x) = static_cast<float>(gy / contrast[0]);
      const Eigen::Vector2d gradient(gx / contrast[0], gy / contrast[0]);
      sum += gradient * gradient.transpose();
    }
  }
  const double weakest = 0.5 * (sum.trace() - std::hypot(sum(0, 0) - sum(1, 1), 2.0 * sum(0, 1)));
  // Both pictures are noisy: the variance of a place is 2 noise^2 over the weakest slope.
  const double relative_noise = noise / contrast[0];
  if (!(weakest > 0.0) || std::sqrt(2.0 / weakest) * relative_noise > kMostPlaceSigma) {
    return std::nullopt;
  }
  patch.step_per_miss = sum.inverse();
  return patch;
}

Eigen::Vector2d StillPatches::placeOf(std::size_t patch) const {
  return (patches_.at(patch).centre - working_middle_) / scale_;
}

// Lucas-Kanade with the slopes of the reference: d += (sum g g^T)^-1 sum g (T - I(x + d)).
std::optional<Eigen::Vector2d> StillPatches::refine(const Patch& patch, const cv::Mat& grey,
                                                    Eigen::Vector2d moved) const {
  const Eigen::Vector2d begin = moved;
  cv::Mat seen = emptyPatch();
  for (int step = 0; step < kSteps; ++step) {
    if (!sample(grey, patch.centre + moved, seen)) return std::nullopt;
    const float* now = seen.ptr<float>();
    const float* then = patch.normalized.ptr<float>();
    const float* gx = patch.gradient_x.ptr<float>();
    const float* gy = patch.gradient_y.ptr<float>();
    float along_x = 0.0F;
    float along_y = 0.0F;
    for (int i = 0; i < kPixels; ++i) {
      const float miss = then[i] - now[i];
      along_x += gx[i] * miss;
      along_y += gy[i] * miss;
    }
    const Eigen::Vector2d change = patch.step_per_miss * Eigen::Vector2d(along_x, along_y);
    moved += change;
    if ((moved - begin).norm() > kReach) return std::nullopt;
    if (change.norm() > kArrived) continue;
    if (seen.dot(patch.normalized) < kLeastCorrelation * kPixels) return std::nullopt;
    return moved;
  }
  return std::nullopt;
}

StillPatches::Motions StillPatches::motionsNear(const cv::Mat& working_grey,
                                                const SharedMotion& expected) const {
  Motions motions(patches_.size());
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const auto found = refine(patches_[i], working_grey, scale_ * expected.at(placeOf(i)));
    if (found) motions[i] = *found / scale_;
  }
  return motions;
}

StillPatches::Motions StillPatches::motionsAnywhere(const cv::Mat& working_grey) const {
  cv::Mat coarse;
  cv::resize(working_grey, coarse, {}, kCoarse, kCoarse, cv::INTER_AREA);
  const cv::Rect all(0, 0, coarse.cols, coarse.rows);
  Motions motions(patches_.size());
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    cv::Mat piece;
    cv::resize(patches_[i].normalized, piece, {}, kCoarse, kCoarse, cv::INTER_AREA);
    // Pixel centres: those of the coarse picture are at (2 c + 0.5) of the working one.
    const Eigen::Vector2d corner =
        (patches_[i].centre - Eigen::Vector2d::Constant(kHalf - 0.5)) * kCoarse;
    const cv::Point place(static_cast<int>(std::lround(corner.x())),
                          static_cast<int>(std::lround(corner.y())));
    const cv::Rect window = cv::Rect(place.x - kCoarseReach, place.y - kCoarseReach,
                                     piece.cols + 2 * kCoarseReach, piece.rows + 2 * kCoarseReach) &
                            all;
    if (window.width < piece.cols || window.height < piece.rows) continue;
    cv::Mat likeness;
    cv::matchTemplate(coarse(window), piece, likeness, cv::TM_CCOEFF_NORMED);
    cv::Point best;
    cv::minMaxLoc(likeness, nullptr, nullptr, nullptr, &best);
    const cv::Point moved = window.tl() + best - place;
    const auto found =
        refine(patches_[i], working_grey, Eigen::Vector2d(moved.x, moved.y) / kCoarse);
    if (found) motions[i] = *found / scale_;
  }
  return motions;
}

}  // namespace gyre
