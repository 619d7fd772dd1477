// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/stepper_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/check.h"

namespace gyre {

void StepperMotion::add(const MotionBlock& block, double time_s) {
  GYRE_CHECK(!full());
  queue_.push_back(block);
  if (!running_ && !held_ && queue_.size() == 1) start(time_s);
}

// Plans the front block from rest at the present position.
void StepperMotion::start(double time_s) {
  const MotionBlock& block = queue_.front();
  const std::int64_t way = block.target_steps - steps_;
  if (way != 0) direction_ = way > 0 ? 1 : -1;
  start_steps_ = steps_;
  start_s_ = time_s;
  offset_steps_ = 0.0;
  length_steps_ = static_cast<double>(std::abs(way));
  acceleration_ = block.acceleration_steps_per_s2;
  // A short way has no cruise: the speed peaks at sqrt(a d).
  peak_ = std::min(block.speed_steps_per_s, std::sqrt(acceleration_ * length_steps_));
  rise_s_ = peak_ / acceleration_;
  cruise_s_ = peak_ > 0.0 ? std::max(0.0, (length_steps_ - peak_ * rise_s_) / peak_) : 0.0;
  duration_s_ = 2.0 * rise_s_ + cruise_s_;
  running_ = true;
  slowing_ = false;
}

double StepperMotion::travelled(double elapsed_s) const {
  const double t = std::clamp(elapsed_s, 0.0, duration_s_);
  const double left_s = duration_s_ - t;
  if (t < rise_s_) return 0.5 * acceleration_ * t * t;
  if (left_s < rise_s_ || slowing_) return length_steps_ - 0.5 * acceleration_ * left_s * left_s;
  return 0.5 * peak_ * rise_s_ + peak_ * (t - rise_s_);
}

double StepperMotion::speedAfter(double elapsed_s) const {
  const double t = std::clamp(elapsed_s, 0.0, duration_s_);
  if (slowing_) return acceleration_ * (duration_s_ - t);
  return std::min({peak_, acceleration_ * t, acceleration_ * (duration_s_ - t)});
}

void StepperMotion::advanceTo(double time_s,
                              const std::function<void(std::int64_t steps)>& on_rest) {
  while (running_) {
    const double elapsed_s = time_s - start_s_;
    if (elapsed_s < duration_s_) {
      const double way = std::floor(offset_steps_ + travelled(elapsed_s));
      steps_ = start_steps_ + direction_ * static_cast<std::int64_t>(way);
      speed_steps_per_s_ = speedAfter(elapsed_s);
      return;
    }
    const double end_s = start_s_ + duration_s_;
    running_ = false;
    speed_steps_per_s_ = 0.0;
    if (slowing_) {
      steps_ = start_steps_ +
               direction_ * static_cast<std::int64_t>(std::floor(offset_steps_ + length_steps_));
      return;
    }
    steps_ = queue_.front().target_steps;
    queue_.pop_front();
    if (on_rest) on_rest(steps_);
    if (!queue_.empty()) start(end_s);
  }
}

void StepperMotion::hold(double time_s) {
  advanceTo(time_s);
  held_ = true;
  if (!running_ || slowing_) return;
  const double made = travelled(time_s - start_s_);
  const double left = length_steps_ - made;
  // From speed v the way to rest is v^2 / 2a, never beyond the end of the block.
  length_steps_ = std::min(left, speed_steps_per_s_ * speed_steps_per_s_ / (2.0 * acceleration_));
  duration_s_ = std::sqrt(2.0 * length_steps_ / acceleration_);
  start_steps_ = steps_;
  offset_steps_ = made + offset_steps_ - std::floor(made + offset_steps_);
  start_s_ = time_s;
  rise_s_ = 0.0;
  slowing_ = true;
}

void StepperMotion::resume(double time_s) {
  GYRE_CHECK(!running_);
  held_ = false;
  if (!queue_.empty()) start(time_s);
}

void StepperMotion::flush() {
  GYRE_CHECK(!running_);
  held_ = false;
  queue_.clear();
}

void StepperMotion::stopDead() {
  running_ = false;
  held_ = false;
  speed_steps_per_s_ = 0.0;
  queue_.clear();
}

void StepperMotion::setSteps(std::int64_t steps) {
  GYRE_CHECK(!running_ && queue_.empty());
  steps_ = steps;
}

}  // namespace gyre
