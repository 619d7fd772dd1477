// How a stepper motor under a motion planner moves: a queue of trapezoids, in simulated time.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>

namespace gyre {

// One planned straight move. Each starts and ends at rest: junctions are not blended.
struct MotionBlock {
  std::int64_t target_steps = 0;
  double speed_steps_per_s = 0.0;          // > 0
  double acceleration_steps_per_s2 = 0.0;  // > 0
};

// Times are simulated seconds and never run backwards. No thread, no clock of its own.
class StepperMotion {
 public:
  static constexpr std::size_t kCapacity = 15;  // blocks, as in the firmware that is modelled

  bool full() const { return queue_.size() >= kCapacity; }
  bool empty() const { return queue_.empty(); }
  std::size_t room() const { return kCapacity - queue_.size(); }
  // Not when full(). Starts at once when it is the only block, unless held.
  void add(const MotionBlock& block, double time_s);

  // Moves on to the time; call before asking for anything. on_rest is told each place at which a
  // block ended meanwhile: the motion may turn back there.
  void advanceTo(double time_s, const std::function<void(std::int64_t steps)>& on_rest = {});

  std::int64_t steps() const { return steps_; }
  double speed() const { return speed_steps_per_s_; }  // along the direction of motion, >= 0
  int direction() const { return direction_; }         // of the latest motion: -1, 0 or +1
  bool moving() const { return running_; }

  // Slows down to rest with the block's acceleration and holds: the queue stays, nothing starts.
  void hold(double time_s);
  bool held() const { return held_; }
  void resume(double time_s);         // goes on with what is left of the queue; only at rest
  void flush();                       // forgets the queue and the hold; only at rest
  void stopDead();                    // the same at once, where it is
  void setSteps(std::int64_t steps);  // only at rest with an empty queue

 private:
  void start(double time_s);
  double travelled(double elapsed_s) const;
  double speedAfter(double elapsed_s) const;

  std::deque<MotionBlock> queue_;
  std::int64_t steps_ = 0;
  double speed_steps_per_s_ = 0.0;
  int direction_ = 0;

  // The profile being run: speed rises from entry to peak, stays, falls to rest.
  bool held_ = false;
  bool running_ = false;
  bool slowing_ = false;  // the profile ends before its block does
  std::int64_t start_steps_ = 0;
  double start_s_ = 0.0;
  double length_steps_ = 0.0;
  double acceleration_ = 0.0;
  double peak_ = 0.0;
  double rise_s_ = 0.0;
  double cruise_s_ = 0.0;
  double duration_s_ = 0.0;
  double offset_steps_ = 0.0;  // fraction of a step already made when the profile began
};

}  // namespace gyre
