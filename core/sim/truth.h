// What a perfect scan of the simulated rig would find.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/task.h"
#include "core/sim/renderer.h"

namespace gyre {

// A vertex is seen in a view when it lies in the picture, neither the object nor the platter hides
// it, and its normal is at most this far from the way to the camera.
inline constexpr double kSteepestView_deg = 70.0;
// The surface counts as seen from so many views on.
inline constexpr int kViewsToBeSeen = 5;

struct Truth {
  Mesh mesh;             // the one that is rendered; `views` and `seen` of each vertex filled in
  double size_mm = 0.0;  // diagonal of its bounding box
};

// The truth about the views taken after these commanded steps. Cancelled by the task.
Result<Truth> truthOf(const Renderer& renderer, std::span<const std::int64_t> steps_of_views,
                      const Task& task);

// The share of the surface that is seen, by area, [0, 1].
double seenShare(const Mesh& truth);

}  // namespace gyre
