// Finds a target by its checkerboards alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/task.h"
#include "core/calib/match/coded_face.h"
#include "core/calib/match/find_target.h"
#include "core/calib/match/lattice_assignment.h"

namespace gyre {

// What a picture shows of an uncoded target, and what it shows beside it.
struct UncodedSearch {
  std::vector<XCorner> corners;
  std::vector<CornerLattice> lattices;
  std::optional<LatticeAssignment> assignment;
  std::vector<FaceSearch> faces;  // with what the assignment predicted and a saddle confirmed

  std::vector<PointSighting> allSightings() const;  // by point
};

UncodedSearch searchUncodedTarget(const TargetPicture& picture, const Target& target,
                                  std::span<const TargetFace> faces,
                                  const FindTargetOptions& options, const Task& task = {});

}  // namespace gyre
