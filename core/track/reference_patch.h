// A piece of the surface as one view saw it, to be found again in others without drift.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

// Where a patch lies in a picture: a point d px beside the patch's middle in its reference picture
// lies at pixel + shape * d + bend * h(d), where h is how far the surface there rises over its
// tangent plane.
struct PatchPlace {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();
  Eigen::Vector2d bend = Eigen::Vector2d::Zero();  // px / mm
};

// Following a feature from view to view adds up small errors: foreshortening and moving shadows
// pull the same way for dozens of views. Aligning each view to one reference instead, with an
// affine shape and whatever brightness, contrast and brightness slope the light gives it, does not.
// Shi and Tomasi, "Good features to track" (1994); Baker and Matthews, "Lucas-Kanade 20 years on"
// (2004), inverse compositional. Immutable; any thread.
class ReferencePatch {
 public:
  // The square of side_px (odd) around the pixel; nothing when it leaves the picture or its texture
  // does not fix a shape. relief: the surface rises by d' relief d / 2 at d px from the middle; a
  // bulge that is taken for flat pulls the patch towards its mean depth. [mm / px^2]
  static std::optional<ReferencePatch> cut(const cv::Mat& grey, const Eigen::Vector2d& pixel,
                                           int side_px,
                                           const Eigen::Matrix2d& relief = Eigen::Matrix2d::Zero());

  struct Alignment {
    PatchPlace place;
    double correlation = 0.0;  // of the aligned patch with the reference
  };

  // Finds the patch in another picture, beginning at a place that is right to two pixels or so; the
  // bend stays as given. Nothing when it runs away, leaves the picture, or its shape degenerates.
  std::optional<Alignment> align(const cv::Mat& grey, const PatchPlace& start) const;

  // Standard deviation of an alignment's pixel, in either direction on average, at this noise of
  // the pictures in grey levels.
  double sigmaPx(double noise_sigma) const { return sigma_per_noise_ * noise_sigma; }

 private:
  ReferencePatch() = default;

  void sample(const cv::Mat& grey, const PatchPlace& place, float* out) const;
  bool inside(const cv::Mat& grey, const PatchPlace& place) const;

  int radius_px_ = 0;
  std::vector<float> heights_mm_;  // over the tangent plane, one a value
  double highest_mm_ = 0.0;        // of these, whatever the sign
  std::vector<float> values_;      // mean 0, length 1
  // Inverse Hessian times steepest descent; rows: dx, dy, then the shape's columns.
  Eigen::Matrix<float, 6, Eigen::Dynamic> descent_;
  double sigma_per_noise_ = 0.0;
};

}  // namespace gyre
