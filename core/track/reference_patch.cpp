// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/reference_patch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace gyre {
namespace {

constexpr int kMostSteps = 10;
constexpr double kSettled_px = 0.01;
constexpr double kRunAway_px = 3.0;
// Shapes squeezed or stretched beyond this are no view of the same surface.
constexpr double kLeastStretch = 0.4;
constexpr double kMostStretch = 2.5;
// Added so that positions are positive and cutting their fraction off rounds down; no patch reaches
// so far.
constexpr int kAboveWhole = 256;
constexpr auto kAbove = static_cast<float>(kAboveWhole);
constexpr float kFlat = 4.0F;  // grey levels; length of a centred patch that holds but noise

// Bilinear value; the caller has made sure that the neighbours exist.
float valueAt(const cv::Mat& grey, double x, double y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const auto fx = static_cast<float>(x - column);
  const auto fy = static_cast<float>(y - row);
  const std::uint8_t* top = grey.ptr<std::uint8_t>(row) + column;
  const std::uint8_t* bottom = grey.ptr<std::uint8_t>(row + 1) + column;
  const float upper = static_cast<float>(top[0]) + fx * static_cast<float>(top[1] - top[0]);
  const float lower =
      static_cast<float>(bottom[0]) + fx * static_cast<float>(bottom[1] - bottom[0]);
  return upper + fy * (lower - upper);
}

bool plausible(const Eigen::Matrix2d& shape) {
  const double area = shape.determinant();
  const double longest = std::sqrt(shape.squaredNorm());
  return area > kLeastStretch * kLeastStretch && area < kMostStretch * kMostStretch &&
         longest < std::sqrt(2.0) * kMostStretch;
}

// Removes from the rows what brightness, contrast and a brightness slope can explain.
template <class Rows, class Photometric>
void projectOut(Rows& rows, Photometric& photometric) {
  for (Eigen::Index i = 0; i < photometric.rows(); ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      photometric.row(i) -= photometric.row(i).dot(photometric.row(k)) * photometric.row(k);
    }
    photometric.row(i).normalize();
  }
  rows -= (rows * photometric.transpose()).eval() * photometric;
}

}  // namespace

bool ReferencePatch::inside(const cv::Mat& grey, const PatchPlace& place) const {
  const Eigen::Vector2d reach = place.shape.cwiseAbs() * Eigen::Vector2d::Constant(radius_px_) +
                                place.bend.cwiseAbs() * highest_mm_;
  return place.pixel.x() - reach.x() >= 1.0 && place.pixel.y() - reach.y() >= 1.0 &&
         place.pixel.x() + reach.x() < grey.cols - 2 && place.pixel.y() + reach.y() < grey.rows - 2;
}

void ReferencePatch::sample(const cv::Mat& grey, const PatchPlace& place, float* out) const {
  const float* height_mm = heights_mm_.data();
  const auto stride = static_cast<std::ptrdiff_t>(grey.step[0]);
  // Counted from a pixel nearby, floats are exact to 1e-5 px.
  const int column = static_cast<int>(place.pixel.x());
  const int row = static_cast<int>(place.pixel.y());
  const std::uint8_t* origin = grey.ptr<std::uint8_t>(row) + column;
  const Eigen::Matrix2f shape = place.shape.cast<float>();
  const Eigen::Vector2f bend = place.bend.cast<float>();
  const Eigen::Vector2f middle(static_cast<float>(place.pixel.x() - column),
                               static_cast<float>(place.pixel.y() - row));
  for (int dy = -radius_px_; dy <= radius_px_; ++dy) {
    const Eigen::Vector2f line = middle + shape.col(1) * static_cast<float>(dy);
    for (int dx = -radius_px_; dx <= radius_px_; ++dx) {
      const float h_mm = *height_mm++;
      const auto along = static_cast<float>(dx);
      const float x = line.x() + shape(0, 0) * along + bend.x() * h_mm + kAbove;
      const float y = line.y() + shape(1, 0) * along + bend.y() * h_mm + kAbove;
      const int whole_x = static_cast<int>(x);
      const int whole_y = static_cast<int>(y);
      const float fx = x - static_cast<float>(whole_x);
      const float fy = y - static_cast<float>(whole_y);
      const std::uint8_t* top = origin + (whole_y - kAboveWhole) * stride + (whole_x - kAboveWhole);
      const std::uint8_t* bottom = top + stride;
      const auto a = static_cast<float>(top[0]);
      const auto b = static_cast<float>(bottom[0]);
      const float upper = a + fx * (static_cast<float>(top[1]) - a);
      const float lower = b + fx * (static_cast<float>(bottom[1]) - b);
      *out++ = upper + fy * (lower - upper);
    }
  }
}

std::optional<ReferencePatch> ReferencePatch::cut(const cv::Mat& grey, const Eigen::Vector2d& pixel,
                                                  int side_px, const Eigen::Matrix2d& relief) {
  ReferencePatch patch;
  patch.radius_px_ = side_px / 2;
  const PatchPlace place{pixel};
  const double margin_px = patch.radius_px_ + 1.0;  // its gradients look one pixel further
  const bool within = pixel.x() - margin_px >= 1.0 && pixel.y() - margin_px >= 1.0 &&
                      pixel.x() + margin_px < grey.cols - 2 &&
                      pixel.y() + margin_px < grey.rows - 2;
  if (!within) return std::nullopt;
  const int count = side_px * side_px;
  patch.heights_mm_.reserve(static_cast<std::size_t>(count));
  for (int dy = -patch.radius_px_; dy <= patch.radius_px_; ++dy) {
    for (int dx = -patch.radius_px_; dx <= patch.radius_px_; ++dx) {
      const Eigen::Vector2d d(dx, dy);
      patch.heights_mm_.push_back(static_cast<float>(0.5 * d.dot(relief * d)));
      patch.highest_mm_ =
          std::max(patch.highest_mm_, static_cast<double>(std::abs(patch.heights_mm_.back())));
    }
  }
  patch.values_.resize(static_cast<std::size_t>(count));
  patch.sample(grey, place, patch.values_.data());
  Eigen::Map<Eigen::RowVectorXf> values(patch.values_.data(), count);
  values.array() -= values.mean();
  const float length = values.norm();
  if (length < kFlat) return std::nullopt;
  values /= length;

  Eigen::Matrix<float, 6, Eigen::Dynamic> steepest(6, count);
  Eigen::Matrix<float, 4, Eigen::Dynamic> photometric(4, count);
  Eigen::Index i = 0;
  for (int dy = -patch.radius_px_; dy <= patch.radius_px_; ++dy) {
    for (int dx = -patch.radius_px_; dx <= patch.radius_px_; ++dx, ++i) {
      const double x = pixel.x() + dx;
      const double y = pixel.y() + dy;
      const float gx = 0.5F * (valueAt(grey, x + 1, y) - valueAt(grey, x - 1, y)) / length;
      const float gy = 0.5F * (valueAt(grey, x, y + 1) - valueAt(grey, x, y - 1)) / length;
      const auto fx = static_cast<float>(dx);
      const auto fy = static_cast<float>(dy);
      steepest.col(i) << gx, gy, gx * fx, gy * fx, gx * fy, gy * fy;
      photometric.col(i) << 1.0F, values[i], fx, fy;
    }
  }
  projectOut(steepest, photometric);
  const Eigen::Matrix<double, 6, 6> hessian = (steepest * steepest.transpose()).cast<double>();
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(hessian);
  if (!(solver.vectorD().minCoeff() > 1e-9)) return std::nullopt;
  const Eigen::Matrix<double, 6, 6> inverse = solver.solve(Eigen::Matrix<double, 6, 6>::Identity());
  patch.descent_ = inverse.cast<float>() * steepest;
  // Both the reference and the other picture are noisy: twice the variance.
  patch.sigma_per_noise_ =
      std::sqrt(2.0 * 0.5 * (inverse(0, 0) + inverse(1, 1))) / static_cast<double>(length);
  return patch;
}

std::optional<ReferencePatch::Alignment> ReferencePatch::align(const cv::Mat& grey,
                                                               const PatchPlace& start) const {
  const auto count = static_cast<Eigen::Index>(values_.size());
  const Eigen::Map<const Eigen::RowVectorXf> reference(values_.data(), count);
  Eigen::VectorXf seen(count);
  Alignment result{start, 0.0};
  for (int step = 0; step < kMostSteps; ++step) {
    if (!inside(grey, result.place)) return std::nullopt;
    sample(grey, result.place, seen.data());
    seen.array() -= seen.mean();
    const float length = seen.norm();
    if (length < kFlat) return std::nullopt;
    seen /= length;
    const float contrast = reference * seen;
    if (contrast < 0.2F) return std::nullopt;
    result.correlation = static_cast<double>(contrast);
    // T(dW(x)) = I(W(x)) solved for dW, then W becomes W o dW^-1.
    const Eigen::Matrix<double, 6, 1> change = (descent_ * seen / contrast).cast<double>();
    Eigen::Matrix2d shape_change;
    shape_change << 1.0 + change[2], change[4], change[3], 1.0 + change[5];
    if (std::abs(shape_change.determinant()) < 0.1) return std::nullopt;
    result.place.shape = result.place.shape * shape_change.inverse();
    const Eigen::Vector2d move = result.place.shape * change.head<2>();
    result.place.pixel -= move;
    if (!plausible(result.place.shape) ||
        (result.place.pixel - start.pixel).squaredNorm() > kRunAway_px * kRunAway_px) {
      return std::nullopt;
    }
    if (move.squaredNorm() < kSettled_px * kSettled_px) return result;
  }
  return result;
}

}  // namespace gyre
