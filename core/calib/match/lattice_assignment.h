// Tells which lattice of corners in a picture is which face of a target, and which way round.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/task.h"
#include "core/calib/corners/corner_lattice.h"
#include "core/calib/lens/rough_pose.h"
#include "core/calib/match/lattice_ways.h"
#include "core/calib/match/target_face.h"
#include "core/calib/match/target_picture.h"
#include "core/scan/target.h"

namespace gyre {

struct LatticeAssignment {
  std::vector<LatticeOnFace> laid;
  RoughPose pose;
  int corners = 0;             // of the target that the lattices cover
  int missing = 0;             // of faces that look at the camera, and not of those lattices
  std::vector<Rigid3> others;  // cam_from_target of the other labellings that fit equally well
};

struct AssignmentInput {
  const TargetPicture& picture;
  const Target& target;
  std::span<const TargetFace> faces;
  std::span<const XCorner> corners;
  std::span<const CornerLattice> lattices;
  // The camera, if known; else its focal length is found too.
  std::optional<CameraModel> camera;
  std::optional<Rigid3> expected_cam_from_target;
};

// The labelling that explains the most corners, and of those that explain as many the one that
// misses least; what none explains is left out as clutter. Between labellings that fit equally
// well, a round mark decides, then which squares are dark, then the expected pose; what then still
// is undecided is told in others, and the first is taken.
//
// Each way to lay each of the largest lattices gives poses; each pose gathers the other lattices
// that lie where it says, and is refined with all of them. Returns nothing when no lattice fits.
std::optional<LatticeAssignment> assignLattices(const AssignmentInput& input,
                                                const Task& task = {});

}  // namespace gyre
