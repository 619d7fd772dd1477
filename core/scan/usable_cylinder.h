// Where an object stays in the picture through the whole turn: a fact for the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

// Upright on the platter, about the axis.
struct UsableCylinder {
  double radius_mm = 0.0;
  double height_mm = 0.0;
};

}  // namespace gyre
