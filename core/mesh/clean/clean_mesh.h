// Cleans up a mesh: all steps that were chosen, in the order in which each helps the next.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/clean_report.h"
#include "core/scan/mesh.h"

namespace gyre {

struct CleanedMesh {
  Mesh mesh;
  CleanReport report;
};

// Whether the options ask for more than tidying: a crop, filling, a base, smoothing, fewer or even
// triangles.
bool changesShape(const CleanOptions& options);

// Merges vertices, removes small pieces, separates surfaces that touch, orients, crops, fills
// holes, caps the base, smooths, reduces and evens triangles, as far as the options ask for each.
// The base that is capped stays flat in the steps after it, and its rim is no hole to be filled;
// small pieces that a crop leaves go too. Vertices keep colour, sigma, views and whether they were
// seen; normals are the mesh's. The input is unchanged, and the same for the same options.
// Fails in words as the steps do, and when a step leaves nothing of the mesh.
Result<CleanedMesh> cleanMesh(const Mesh& mesh, const CleanOptions& options, const Task& task);

inline constexpr std::size_t kCleanSteps = 10;

// Gives what cleanMesh gives, and remembers what each step made: the next clean-up of the same mesh
// begins at the first step whose options are others, as when somebody drags a slider. Keeps up to
// one mesh for each step. One thread at a time.
class RepeatedCleanUp {
 public:
  Result<CleanedMesh> run(const MeshPtr& mesh, const CleanOptions& options, const Task& task);

 private:
  using CleanedPtr = std::shared_ptr<const CleanedMesh>;

  MeshPtr mesh_;
  CleanedPtr begun_;  // before the first step
  CleanOptions options_;
  std::array<CleanedPtr, kCleanSteps> after_;  // null from where the last clean-up did not come to
};

}  // namespace gyre
