// Finds out by a camera whether a table that obeys does turn: nothing of it need be known.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"

namespace gyre {

struct MotorSeen {
  bool turns = false;
  double told_rad = 0.0;  // in all, until motion was seen or the search was given up
};

// Makes small moves, each twice the last, until something in the picture has moved, and goes back
// to where it began; gives up once 51 degrees were told in all. Even a board that turns the table
// 50 times as far as it is told moves it by a few degrees only before that is seen.
//
// Fails when the picture moves while the table stands, so that nothing can be told, and on every
// failure of a device; the table is then stopped.
Result<MotorSeen> watchMotor(Turntable& turntable, Camera& camera, const Task& task);

// What to say of a motor that stands: what was told and seen, and what to check.
Error motorStands(double told_rad);

}  // namespace gyre
