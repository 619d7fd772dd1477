// The motor's shaft: what the simulated firmware turns and the simulated camera sees turning.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace gyre {

// Whole motor steps since the rig was built; a reset of the firmware does not change them. The
// firmware writes, anyone reads.
class Shaft {
 public:
  std::int64_t steps() const { return steps_.load(std::memory_order_acquire); }
  void setSteps(std::int64_t steps) { steps_.store(steps, std::memory_order_release); }

 private:
  std::atomic<std::int64_t> steps_{0};
};

}  // namespace gyre
