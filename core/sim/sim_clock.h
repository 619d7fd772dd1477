// Simulated time: the steady clock, run faster.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"

namespace gyre {

// A value; copies tell the same time. Any thread.
class SimClock {
 public:
  // speed: simulated seconds per real second, > 0.
  explicit SimClock(double speed = 1.0) : speed_(speed), start_s_(steadySeconds()) {}

  double seconds() const { return (steadySeconds() - start_s_) * speed_; }  // simulated, from 0
  double realSecondsFor(double simulated_s) const { return simulated_s / speed_; }
  double speed() const { return speed_; }

 private:
  double speed_;
  double start_s_;
};

}  // namespace gyre
