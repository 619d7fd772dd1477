// Pictures of the simulated rig, rendered before any clock runs and kept in memory.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scan/frame.h"
#include "core/sim/renderer.h"

namespace gyre::bench {

// The first so many views of a scan that takes views_per_turn of them, at the angles told.
std::vector<FramePtr> renderViews(const Renderer& renderer, int views_per_turn, int views);

// Every n-th of the views, as a scan of its own; shares their pictures.
std::vector<FramePtr> everyNth(const std::vector<FramePtr>& views, std::size_t n);

FramePtr renderEmptyTable(const Renderer& renderer);  // at angle 0

// The motor's steps from the first view to this one.
std::int64_t stepsTo(const RigSettings& rig, int view, int views_per_turn);

}  // namespace gyre::bench
