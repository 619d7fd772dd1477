// Finds a known target in a picture, or says in words why it is not found.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/frame.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre {

struct FindTargetOptions {
  // Fewer points of the target are not a find. [points], 4 .. 10000
  int min_points = 8;
  // The camera when it is known, even roughly: makes uncoded targets surer.
  std::optional<CameraModel> camera;
  // Where the target is expected, to a few degrees, from a previous solution: decides between
  // labellings of a target that looks the same from several sides.
  std::optional<Rigid3> expected_cam_from_target;

  Result<void> validate() const;
};

// What was seen of one face.
struct FaceFinding {
  int face = -1;     // index into the target's faces, -1 for markers of none
  int seen = 0;      // points
  int expected = 0;  // points that the face has
};

struct FoundTarget {
  TargetView view;                 // its name and angle are the caller's to fill
  std::vector<FaceFinding> faces;  // those of which anything was seen
  // In how many ways the points can be named so that the picture fits equally well. More than one:
  // the target looks the same from several sides; one way was taken, and a series of pictures needs
  // findTargets() to name all alike.
  int labellings = 1;
  // Where the target is, and through what camera, as far as one picture tells: good to predict the
  // next picture, not to measure. None for coded targets, which need neither.
  std::optional<Rigid3> cam_from_target;
  std::optional<CameraModel> camera;
  // The same under the other labellings.
  std::vector<Rigid3> other_cam_from_target;
};

// The target in a picture of 8 bits, colour or grey.
//
// Coded targets: each corner is predicted from the codes around it and measured as a saddle; a
// face without corners gives the corners of its markers instead, from lines along their sides.
// Uncoded targets: lattices of corners are grown and fitted to the faces. A target that lacks
// both, or whose faces are no lattices, is an error. sigma_px of each sighting is its predicted
// standard deviation.
//
// When there is no find, the error names what hindered it as far as the picture shows: absent,
// another target, blurred, over-exposed, too dark, cut off, too small, or too few points.
Result<FoundTarget> findTarget(const cv::Mat& image, const Target& target,
                               const FindTargetOptions& options = {}, const Task& task = {});

}  // namespace gyre
