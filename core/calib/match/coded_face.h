// Finds the corners of a face whose coded squares were read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/calib/corners/plane_homography.h"
#include "core/calib/match/marker_detection.h"
#include "core/calib/match/target_face.h"
#include "core/calib/match/target_picture.h"
#include "core/scan/target_view.h"

namespace gyre {

// What a picture shows of one face.
struct FaceSearch {
  int face = -1;                      // index into the target's faces
  std::vector<PlaneSighting> guides;  // what predicted the corners; weight 1 / sigma_px
  std::vector<PointSighting> sightings;
  int outside = 0;    // corners that are predicted beyond the picture's edge
  int too_small = 0;  // corners whose surroundings are less than a few pixels wide
  int unseen = 0;     // corners that are predicted in the picture and not there
};

// Each corner is predicted from the codes around it, looked for by a saddle fit no further away
// than 0.3 squares, and kept when its neighbours agree with it; nothing supposes that the lens is
// free of distortion. Markers of other faces are ignored, and those that the others contradict.
// Returns nothing when no marker of the face is among the detected.
std::optional<FaceSearch> searchCodedFace(const TargetPicture& picture, const TargetFace& face,
                                          std::span<const DetectedMarker> detected,
                                          int modules_a_side);

// Looks for those corners of a face that are not among the search's sightings yet, guided by the
// latter and the guides.
void completeFace(const TargetPicture& picture, const TargetFace& face, FaceSearch& search);

// Takes out the sightings that do not lie where those around them say, the worst first.
void dropStrays(const TargetFace& face, FaceSearch& search);

}  // namespace gyre
