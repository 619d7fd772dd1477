// The motion that most of many small image motions share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// Where something was seen, measured from the middle of the picture, and how far it moved. [px]
struct ImageMotion {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
};

// A small similarity: moved = shift + stretch * place + turn * (-place.y, place.x).
struct SharedMotion {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double stretch = 0.0;   // relative
  double turn_rad = 0.0;  // clockwise in the picture, since y goes down
  // Of (shift x, shift y, stretch, turn), from the scatter of those who share it.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  std::vector<bool> shares;  // one a motion given
  std::size_t sharing = 0;

  Eigen::Vector2d at(const Eigen::Vector2d& place) const {
    return shift_px + stretch * place + turn_rad * Eigen::Vector2d(-place.y(), place.x());
  }
  // Root mean square of the motion over a picture of this size, and of its error. [px]
  double rmsPx(const Eigen::Vector2d& picture_size_px) const;
  double rmsSigmaPx(const Eigen::Vector2d& picture_size_px) const;
};

// The motion that the most of them share to within tolerance_px, or a third of its own size when
// that is more: what is nearer to a bumped camera moves further. Nothing when fewer than four do.
// Deterministic.
std::optional<SharedMotion> sharedMotion(const std::vector<ImageMotion>& motions,
                                         double tolerance_px);

}  // namespace gyre
