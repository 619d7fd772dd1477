// One draw of the paper's synthetic experiment, measured in every way.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/sim/synthetic_turn.h"

namespace gyre {

// The ways to find points, in the order of the table's columns.
inline constexpr std::array<const char*, 4> kAloneSolvers = {"two-view", "squared", "absolute",
                                                             "robust"};
inline constexpr std::size_t kJointWay = kAloneSolvers.size();
inline constexpr std::size_t kWays = kAloneSolvers.size() + 1;

struct WayOutcome {
  double sum_mm = 0.0;  // of the distances from the truth
  int found = 0;        // points
};

struct TrialOutcome {
  std::array<WayOutcome, kWays> ways;
  double bound_mm = 0.0;        // least mean error of points that are found one by one
  double joint_bound_mm = 0.0;  // likewise of points and angles together, up to one turn
};

// angle_freedom_deg: how far the joint solution believes the angles may be off. Any thread.
TrialOutcome noiseTrial(const SyntheticTurnOptions& options, double angle_freedom_deg,
                        std::uint64_t seed);

}  // namespace gyre
