// Measures how far a target on the table has turned between pictures of an uncalibrated camera.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre {

struct TurnReading {
  double angle_rad = 0.0;  // counter-clockwise from above, from the reference; not wrapped
  double sigma_rad = 0.0;  // one standard deviation, from the scatter of the sightings
  double rms_px = 0.0;     // how far the sightings miss
};

// The target stands on the table, so between two pictures it only turns about its own upright axis
// and shifts along the platter: three unknowns, whatever the focal length. That and the pose in the
// reference picture are guessed from a ladder of focal lengths; what explains all pictures so far
// best is believed. Right in sign, and in size to a few percent. One thread.
class TurnGauge {
 public:
  // Fails when the reference shows too little of the target to tell its pose.
  static Result<TurnGauge> create(const Target& target, const TargetView& reference,
                                  const Eigen::Vector2i& picture_size_px);

  // Starts at the reading before: between two pictures the table turns by less than about 25
  // degrees. Nothing when fewer than four points are seen, or when they do not fit a turn.
  std::optional<TurnReading> read(const TargetView& view);

 private:
  // One guess of camera and pose, and what it made of the pictures so far.
  struct Guess {
    CameraModel camera;
    Rigid3 cam_from_target;                                    // in the reference picture
    Eigen::Vector3d turn_and_shift = Eigen::Vector3d::Zero();  // of the last picture: rad, mm, mm
    double squares_px2 = 0.0;                                  // of all misses so far
  };
  struct Fit {
    Eigen::Vector3d turn_and_shift;
    double sigma_rad = 0.0;
    double squares_px2 = 0.0;  // outliers at their limit
  };

  std::optional<Fit> fit(const Guess& guess, const TargetView& view) const;

  std::vector<TargetPoint> points_;
  std::vector<Guess> guesses_;
};

}  // namespace gyre
