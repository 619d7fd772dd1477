// What cleaning up a mesh did, step by step.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/scan/mesh_health.h"

namespace gyre {

// One number with its words: "holes filled", 3, "".
struct CleanFigure {
  std::string what;  // in words for the user, lower case
  double value = 0.0;
  std::string unit;  // "mm", "mm^2", or empty for a count
};

struct CleanStep {
  std::string name;  // in words for the user: "Crop"
  std::size_t triangles_before = 0;
  std::size_t triangles_after = 0;
  std::vector<CleanFigure> figures;
};

struct CleanReport {
  MeshHealth before;
  MeshHealth after;
  std::vector<CleanStep> steps;  // in the order in which they were done
};

}  // namespace gyre
