// The motor's shaft, which the simulated firmware turns, and the table on it, which the simulated
// camera sees turning.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace gyre {

// Whole motor steps since the rig was built; a reset of the firmware does not change them. The
// firmware writes, anyone reads.
class Shaft {
 public:
  // play_steps: what gears or belt let the motor turn back before the table follows. At first they
  // are engaged as after a forward move. >= 0
  explicit Shaft(std::int64_t play_steps = 0) : play_steps_(play_steps) {}

  // Of the motor.
  std::int64_t steps() const { return steps_.load(std::memory_order_acquire); }
  // Of the table: the same without play.
  std::int64_t tableSteps() const { return table_steps_.load(std::memory_order_acquire); }

  void setSteps(std::int64_t steps) {
    steps_.store(steps, std::memory_order_release);
    table_steps_.store(std::clamp(tableSteps(), steps, steps + play_steps_),
                       std::memory_order_release);
  }

 private:
  const std::int64_t play_steps_;
  std::atomic<std::int64_t> steps_{0};
  std::atomic<std::int64_t> table_steps_{0};
};

}  // namespace gyre
