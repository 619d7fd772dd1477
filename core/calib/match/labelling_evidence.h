// What speaks for one way of naming the corners in a picture and against another.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/calib/match/lattice_assignment.h"

namespace gyre {

// Whether the face's outside is seen at more than the given cosine to its normal.
bool looksAtCamera(const TargetFace& face, const Rigid3& cam_from_target, double least_cosine);

// How many corners of faces that look at the camera, within the picture, no lattice covers.
int missingCorners(const AssignmentInput& input, const LatticeAssignment& labelling);

// Round marks that are where the labelling says, less those that should be and are not.
int marksSeen(const AssignmentInput& input, const LatticeAssignment& labelling);

// See assignLattices(). Nothing when there is none to choose from.
std::optional<LatticeAssignment> bestLabelling(const AssignmentInput& input,
                                               std::vector<LatticeAssignment> labellings);

}  // namespace gyre
