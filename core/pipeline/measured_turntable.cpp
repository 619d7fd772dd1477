// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/measured_turntable.h"

#include <algorithm>

#include "core/base/units.h"

namespace gyre {
namespace {

// Past the play itself: it grows with wear, and was measured with an error.
constexpr double kMargin_rad = radFromDeg(0.5);

}  // namespace

void takeUpBacklash(Turntable& turntable, double backlash_rad) {
  if (!(backlash_rad > 0.0)) return;
  turntable.setApproach(std::max(turntable.approachRad(), backlash_rad + kMargin_rad));
}

CalibratedTurntable measuredTurntable(const TurntableInfo& info, const CalibrationRecord& record) {
  const auto& known = record.turntable;
  if (!known || known->device_id != info.device_id || known->axis != info.axis) return {};
  return *known;
}

}  // namespace gyre
