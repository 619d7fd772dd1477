// What the tracker saw in one frame: for the eyes of the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/scan/drift.h"
#include "core/scan/frame.h"

namespace gyre {

enum class FeatureState : std::uint8_t {
  kNew,       // seen once
  kTracked,   // followed, its point not yet certain
  kMeasured,  // its point is recovered
};

struct FeatureMark {
  std::uint32_t track_id = 0;
  FeatureState state = FeatureState::kNew;
  std::vector<Eigen::Vector2f> tail;  // pixels of the last views, newest last, never empty
};

struct TrackedFrame {
  FramePtr frame;
  std::vector<FeatureMark> marks;
  ViewDrift drift;  // as far as it could be told by then
};

}  // namespace gyre
