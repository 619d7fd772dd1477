// What only a simulated scan can have: the truth, and how far the result lies from it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/scan_store.h"
#include "core/pipeline/reconstruction.h"
#include "core/scan/comparison.h"
#include "core/sim/renderer.h"

namespace gyre {

struct Judgement {
  double size_mm = 0.0;  // diagonal of the true object's bounding box
  Comparison points;     // `at` holds one distance: 2 % of the size
};

// Writes truth.ply and truth.json into the scan's folder and measures the points against the truth.
// The result is used for nothing but this.
Result<Judgement> judgeDemo(const Renderer& renderer, const ScanStore& store,
                            const Reconstruction& reconstruction, const Task& task);

// The judgement in lines for people.
std::string judgementText(const Judgement& judgement);

}  // namespace gyre
