// A picture of a measured surface, redrawn as if the camera had looked at it level.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include <Eigen/Core>

#include "core/geometry/posed_camera.h"
#include "core/scan/frame.h"
#include "core/scan/mesh.h"

namespace gyre {

// A camera that looks down on an object sees its wall from 30 degrees above; when the object was
// turned over, from 30 degrees below: too far apart for what is told by its looks. Seen level, both
// are alike, but for half a turn.
class LevelPicture {
 public:
  // grey: 8 bit, as `camera` took it. mesh: the surface in the table frame; what no camera saw of
  // it hides what is behind, and is not drawn.
  LevelPicture(const Mesh& mesh, const PosedCamera& camera, const cv::Mat& grey);

  // 8 bit; from the side of the camera, without lens distortion, and no larger than it must be.
  // Empty where nothing can be drawn: a camera straight above.
  const cv::Mat& grey() const { return grey_; }
  // 255 where the surface was drawn, some pixels away from where it was not.
  const cv::Mat& mask() const { return mask_; }

  // Place and outward normal, in the table frame, behind a pixel of grey(); nothing where the
  // surface is met at a slant.
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> at(const Eigen::Vector2d& pixel) const;

 private:
  void draw(const Mesh& mesh, const PosedCamera& from, const cv::Mat& grey);
  std::optional<Eigen::Vector3d> placeAt(const Eigen::Vector2d& pixel) const;

  PosedCamera camera_;  // the level one
  cv::Mat depth_;       // mm along its axis; 0 where nothing is drawn
  cv::Mat grey_;
  cv::Mat mask_;
};

}  // namespace gyre
