// Small pieces of a reference picture, found again in later pictures of the same scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"
#include "core/track/common_motion.h"

namespace gyre {

// Works on copies of about 640 pixels width, so that its cost does not grow with the camera; places
// and motions are given in pixels of the full picture. Immutable after construction; any thread.
class StillPatches {
 public:
  // Takes at most one piece from each cell of a 16 x 12 grid: the place that can be found again
  // most exactly. Cells whose texture does not rise above the noise give none.
  explicit StillPatches(const cv::Mat& reference_bgr);

  std::size_t count() const { return patches_.size(); }
  const Eigen::Vector2d& pictureSizePx() const { return size_px_; }
  double pxPerWorkingPx() const { return 1.0 / scale_; }

  // From the middle of the picture. [px of the full picture]
  Eigen::Vector2d placeOf(std::size_t patch) const;

  // How far each piece has moved in the picture, searched around what is expected: where the
  // brightness differs by a factor and an offset only. Nothing for a piece that is covered or has
  // changed. The search reaches about 3 working pixels. [px of the full picture]
  using Motions = std::vector<std::optional<Eigen::Vector2d>>;
  Motions motionsNear(const cv::Mat& working_grey, const SharedMotion& expected) const;

  // The same without knowing anything, as far as 64 working pixels: slower, about 30 ms.
  Motions motionsAnywhere(const cv::Mat& working_grey) const;

  // The picture as the searches want it.
  cv::Mat workingGrey(const cv::Mat& image_bgr) const;

 private:
  struct Patch {
    Eigen::Vector2d centre;         // working pixels
    cv::Mat normalized;             // CV_32F, mean 0, root mean square 1
    cv::Mat gradient_x;             // of normalized
    cv::Mat gradient_y;             // likewise
    Eigen::Matrix2d step_per_miss;  // inverse of sum g g^T
  };

  std::optional<Patch> patchAt(const cv::Mat& grey, const cv::Point& centre, double noise) const;
  std::optional<Eigen::Vector2d> refine(const Patch& patch, const cv::Mat& grey,
                                        Eigen::Vector2d moved) const;

  double scale_ = 1.0;  // working over full
  Eigen::Vector2d size_px_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d working_middle_ = Eigen::Vector2d::Zero();
  std::vector<Patch> patches_;
};

}  // namespace gyre
