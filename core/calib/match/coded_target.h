// Finds a target by the ids of its coded squares.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/calib/match/coded_face.h"
#include "core/calib/match/marker_detection.h"
#include "core/calib/match/target_face.h"
#include "core/calib/match/target_picture.h"
#include "core/scan/target.h"

namespace gyre {

// What a picture shows of a coded target, and what it shows beside it.
struct CodedSearch {
  MarkerDetection detection;
  int own_markers = 0;                          // of the target's ids
  int stranger_markers = 0;                     // of its dictionary but not of its ids
  std::vector<FaceSearch> faces;                // faces of which a marker was read
  std::vector<PointSighting> marker_sightings;  // of markers on no face that has corners

  std::vector<PointSighting> allSightings() const;  // by point
};

// target: with a dictionary. faces: from facesOf(target). Fails when the dictionary is unknown.
Result<CodedSearch> searchCodedTarget(const TargetPicture& picture, const Target& target,
                                      std::span<const TargetFace> faces);

}  // namespace gyre
