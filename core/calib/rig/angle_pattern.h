// What the solved angles say of the motor: its scale, its errors that come back, where it jumped.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/scan/calibration_report.h"

namespace gyre {

// A stretch of pictures between which the table did not move as it does elsewhere.
struct AngleJump {
  std::size_t first = 0;          // index of the last regular picture before it
  std::vector<double> moved_rad;  // how far it moved, a number a step
  double expected_rad = 0.0;      // how far it should have, at the first of them
};

// An error that comes back several times a turn, or out of step with it.
struct AngleRipple {
  double amplitude_rad = 0.0;
  double period_rad = 0.0;  // of the table's angle
};

struct AnglePattern {
  std::optional<double> step_scale;  // signed; none without commands
  double step_rad = 0.0;             // the usual one between neighbouring pictures
  TurnHarmonic once_per_turn;        // zero when the pictures cover too little of a turn
  TurnHarmonic twice_per_turn;
  std::vector<AngleJump> jumps;
  std::vector<AngleRipple> ripples;  // largest first
  double white_rad = 0.0;            // what is left, one standard deviation
};

struct AnglePatternOptions {
  // Smaller errors than this are not worth a word. [rad], > 0
  double least_rad = 3e-4;
  // How many standard deviations of all steps one must be off to be a jump. > 3
  double jump_sigma = 6.0;
};

// The angles in the order of the pictures, unwrapped. Pictures without commands count as evenly
// commanded when they were evenly turned; otherwise nothing but the angles can be said of them.
AnglePattern anglePatternOf(const std::vector<double>& angles_rad,
                            const std::vector<std::optional<double>>& commanded_rad,
                            const AnglePatternOptions& options = {});

// The sentences of a pattern for the user: one a jump, one a ripple. view_names: for the jumps.
std::vector<std::string> sentencesOf(const AnglePattern& pattern,
                                     const std::vector<std::string>& view_names);

}  // namespace gyre
