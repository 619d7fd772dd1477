// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/watch_motor.h"

#include "core/base/clock.h"
#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/pipeline/settling.h"

namespace gyre {
namespace {

constexpr double kFirst_rad = radFromDeg(0.1);
constexpr double kMost_rad = radFromDeg(51.0);

Error restless() {
  return {Error::Code::kRejected, "The picture moves though the table stands.",
          "Keep hands and lamps still, and let nothing but the table fill the picture."};
}

// The picture of the table at rest. Two in a row must agree.
Result<FramePtr> pictureAtRest(Camera& camera, const Task& task) {
  Settling settling;
  auto first = settling.grabStill(camera, steadySeconds(), task);
  if (!first) return first;
  auto second = camera.grabAfter((*first)->time_s, task);
  if (!second) return second;
  if (somethingMoved((*first)->image_bgr, (*second)->image_bgr)) return restless();
  return second;
}

Result<MotorSeen> watch(Turntable& turntable, Camera& camera, const Task& task) {
  const auto before = pictureAtRest(camera, task);
  if (!before) return before.error();
  const Task silent(task.stopToken());
  const double begin_rad = turntable.angleRad();
  MotorSeen seen;
  for (double by_rad = kFirst_rad; !seen.turns && seen.told_rad < kMost_rad; by_rad *= 2.0) {
    seen.told_rad += by_rad;
    task.report(seen.told_rad / (2.0 * kMost_rad), "Looking whether the motor turns");
    const auto moved = turntable.moveTo(begin_rad + seen.told_rad, silent);
    if (!moved) return moved.error();
    const auto after = Settling().grabStill(camera, steadySeconds(), silent);
    if (!after) return after.error();
    seen.turns = somethingMoved((*before)->image_bgr, (*after)->image_bgr);
  }
  if (const auto back = turntable.moveTo(begin_rad, silent); !back) return back.error();
  task.report(1.0, "The motor was watched");
  return seen;
}

}  // namespace

Result<MotorSeen> watchMotor(Turntable& turntable, Camera& camera, const Task& task) {
  auto seen = watch(turntable, camera, task);
  if (!seen) turntable.stop();
  return seen;
}

Error motorStands(double told_rad) {
  return {
      Error::Code::kRejected,
      formatted("It obeys and was told to turn by %.2g\u00b0, and the camera sees nothing move.",
                degFromRad(told_rad)),
      "Check the motor's power and its plug, that the right axis is named, and that the camera "
      "sees the table with something on it."};
}

}  // namespace gyre
