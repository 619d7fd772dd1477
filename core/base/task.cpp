// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/task.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace gyre {

Task::Task(std::stop_token stop_token, Reporter reporter)
    : stop_token_(std::move(stop_token)), reporter_(std::move(reporter)) {}

void Task::report(double fraction, std::string_view stage) const {
  if (reporter_) reporter_(from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0), stage);
}

Task Task::part(double from, double to) const {
  Task inner = *this;
  inner.from_ = from_ + (to_ - from_) * from;
  inner.to_ = from_ + (to_ - from_) * to;
  return inner;
}

bool Task::sleepFor(double seconds) const {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  wake.wait_for(lock, stop_token_, std::chrono::duration<double>(seconds), [] { return false; });
  return !stopRequested();
}

}  // namespace gyre
