// Conversions at the borders. Inside the core: millimetres, radians, seconds, pixels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace gyre {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTurn_rad = 2.0 * kPi;

constexpr double radFromDeg(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double degFromRad(double angle_rad) { return angle_rad * (180.0 / kPi); }

}  // namespace gyre
