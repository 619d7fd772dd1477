// Camera, axis and step of a turntable of which nothing is known, told by what its pictures share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/calibration.h"

namespace gyre {

// The same spot in two pictures, between which the table turned.
struct TurnedMatch {
  Eigen::Vector2d first_px;
  Eigen::Vector2d second_px;
  double turn = 0.0;  // by how much: rad where angles are known, steps where they are not
};

struct RoughTurntableOptions {
  int width_px = 0;
  int height_px = 0;
  bool angles_known = false;
  // Where they are not: the step, either way round. Pictures of an unknown camera tell it badly, as
  // a larger step of a flatter object, seen through a longer lens, looks much the same. [rad], > 0
  double step_rad = 0.0;
  double tolerance_px = 1.0;  // how far matches may miss each other's epipolar lines, > 0
};

struct RoughTurntable {
  // Square pixels, no distortion, the optical axis through the picture's middle. The table's frame
  // has its x axis under the camera, the camera at z = 0, and the axis at distance 1: sizes are not
  // told. Up along the axis is up in the picture, as far as it can be.
  Calibration calibration;
  double step_rad = 0.0;     // as told, negative for clockwise from above; 1 where angles are known
  std::size_t agreeing = 0;  // matches
  // The spots that agree, where their rays meet: how large the object is, and how it lies.
  std::vector<Eigen::Vector3d> spots_in_table;
};

// Views of a turning table differ by a turn about the axis, in the camera's frame: so the camera's
// direction towards the axis (3) and its focal length leave their marks in the epipolar lines of
// every two pictures. These four are found by least squares of Sampson's distance,
// robustly (Cauchy), from starts all over what tables and cameras are like.
//
// kTooFew when fewer than a fifth of the matches agree, or there are fewer than 50. kCancelled when
// stopped. The same for any number of threads. Fitzgibbon, Cross and Zisserman, "Automatic 3D model
// construction for turn-table sequences" (1998), who stay projective; here pixels are square.
Result<RoughTurntable> roughTurntable(std::span<const TurnedMatch> matches,
                                      const RoughTurntableOptions& options, const Task& task);

// A calibration that is roughly right, its camera turned where it stands until the matches agree:
// for a camera that was nudged, or measured with a ruler. The lens is believed. The matches' turns
// are in rad. Fails like roughTurntable.
Result<Calibration> turnedCalibration(std::span<const TurnedMatch> matches,
                                      const Calibration& calibration, double tolerance_px,
                                      const Task& task);

}  // namespace gyre
