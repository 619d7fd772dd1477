// Tells how far a result lies from a reference, and how much of the reference it covers.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/scan/comparison.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

enum class Alignment {
  kNone,   // both are in the same frame: the usual case, and the stricter one
  kRigid,  // the result is first moved and turned to fit; both must already lie roughly alike
};

struct CompareOptions {
  // Distances at which precision, completeness and F-score are told. [mm], > 0
  std::vector<double> at_mm = {0.25, 0.5, 1.0};
  // How many places of a mesh are measured, uniform by area; clouds are taken as they are. >= 1
  std::size_t samples = 100000;
  Alignment alignment = Alignment::kNone;
  // Where histogram and colours end; 0 chooses a round number by the distances. [mm], >= 0
  double scale_mm = 0.0;
  // Only reference surface seen by so many views counts, by MeshVertex::views. 0: all of it counts.
  double min_views_seen = 0.0;
  // The result is judged above this height only, which leaves the platter out. [mm], table frame
  double min_height_mm = -std::numeric_limits<double>::infinity();

  Result<void> validate() const;
};

// Distances from the result to the reference's surface, and back. A mesh without triangles is a
// cloud: its vertices are measured, and as a reference they are all there is. The same input gives
// the same numbers, whatever the number of threads.
// Fails in words when one of the two is empty, has a coordinate that is no number, or when no part
// of them is left to judge.
Result<Comparison> compareSurfaces(const Mesh& result, const Mesh& reference,
                                   const CompareOptions& options, const Task& task);

// How far each vertex of the result lies from the reference's surface, as they lie. [mm] Both hold
// points with finite coordinates. Fails only when stopped.
Result<std::vector<double>> vertexDistances(const Mesh& result, const Mesh& reference,
                                            const Task& task);

// That one of two shapes is in another unit.
struct UnitDoubt {
  Error words;
  bool certain = false;  // no part of anything is so much smaller than the whole
};

// By the sizes of both: when the one is larger by what a metre, an inch or a centimetre is to a
// millimetre, to 5 %, or 200 times and more. Nothing otherwise, and where one has no size.
std::optional<UnitDoubt> unitDoubt(const Mesh& result, const Mesh& reference);

// The points of a cloud as a mesh without triangles.
Mesh meshOfPoints(const PointCloud& cloud);

// The options by which a simulated scan is judged: seen means seen in at least 5 views, and samples
// count from 1 % of the reference's diagonal above the platter.
CompareOptions judgingOptions(const Mesh& reference);

}  // namespace gyre
