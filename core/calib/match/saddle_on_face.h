// Measures an X-corner of a face in the picture as if one looked straight at the face.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/calib/match/target_picture.h"

namespace gyre {

// What is known of the corner before it is measured.
struct SaddleOnFace {
  Eigen::Vector2d place_mm = Eigen::Vector2d::Zero();              // on the face
  Eigen::Matrix3d pixel_from_place = Eigen::Matrix3d::Identity();  // homography around it
  double clear_mm = 0.0;  // how far around it only its own two edges are printed
  double disc = 0.8;      // share of this distance that the fit may use
};

struct MeasuredSaddle {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 0.0;  // standard deviation of either coordinate
};

// The surroundings are drawn upright, no pixel of the picture smaller than one of the drawing, and
// the saddle is fitted there: a face at a glancing angle keeps a round disc between its codes where
// the picture itself has none. Nothing when there is no saddle, when it leaves the picture, or when
// the clear surroundings are less than 1.6 px wide in the picture.
std::optional<MeasuredSaddle> measureSaddle(const TargetPicture& picture,
                                            const SaddleOnFace& corner);

// The least distance in the picture that the clear surroundings keep. [px]
double clearInPicture_px(const SaddleOnFace& corner);
inline constexpr double kLeastClear_px = 1.6;

}  // namespace gyre
