// Turns Ctrl-C and `kill` into a stop request.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>
#include <thread>

namespace gyre {

// From its making on, SIGINT and SIGTERM are blocked in this thread and those it starts, and the
// first of them requests a stop. A second one ends the program at once: it then has its usual
// effect again. Made before any other thread; one at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread listener_;
};

}  // namespace gyre
