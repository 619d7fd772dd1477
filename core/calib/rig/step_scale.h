// How far and which way a table turns for what it is told, from the angles that pictures show.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

namespace gyre {

// The smallest and largest ratio between turned and told that is looked for.
inline constexpr double kLeastStepScale = 1.0 / 50.0;
inline constexpr double kMostStepScale = 50.0;

// Turned over told, negative when the table turns clockwise for positive commands. Seen angles are
// known up to whole turns; of the ratios that explain them equally well, which evenly spaced
// commands always leave, one near 1 is taken, else the one with the least motion. Robust to a few
// wrong angles.
//
// Nothing when fewer than two different commands have an angle.
std::optional<double> stepScaleFrom(const std::vector<std::optional<double>>& commanded_rad,
                                    const std::vector<std::optional<double>>& seen_rad);

// Adds whole turns to the seen angles so that each lies next to scale * commanded; where there is
// no command, next to the angle before it. What was not seen gets scale * commanded, or 0.
std::vector<double> unwrappedAngles(const std::vector<std::optional<double>>& commanded_rad,
                                    const std::vector<std::optional<double>>& seen_rad,
                                    double step_scale);

}  // namespace gyre
