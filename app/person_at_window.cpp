// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/person_at_window.h"

#include <cmath>
#include <cstdlib>

namespace gyre {
namespace {

HandTurnFacts factsOf(const HandTurn& turn) {
  HandTurnFacts facts;
  facts.marks = std::llabs(turn.ticks);
  facts.counter_clockwise = turn.ticks > 0;
  facts.mark_deg = turn.tick_deg;
  facts.to_mark = std::llround(turn.to_deg / turn.tick_deg);
  facts.to_deg = turn.to_deg;
  return facts;
}

}  // namespace

AskPerson PersonAtWindow::ask() {
  return [this](const HandTurn& turn, const Task& task) { return await(turn, task); };
}

Result<void> PersonAtWindow::await(const HandTurn& turn, const Task& task) {
  std::unique_lock lock(mutex_);
  const std::int64_t number = ++asked_;
  QMetaObject::invokeMethod(
      this,
      [this, number, facts = factsOf(turn)] {
        shown_ = number;
        Q_EMIT asked(facts);
      },
      Qt::QueuedConnection);
  const bool done =
      changed_.wait(lock, task.stopToken(), [this, number] { return answered_ == number; });
  lock.unlock();
  QMetaObject::invokeMethod(this, &PersonAtWindow::settled, Qt::QueuedConnection);
  return done ? Result<void>() : cancelled();
}

// A key that is pressed twice does not answer a question that nobody has read.
void PersonAtWindow::done() {
  {
    const std::lock_guard lock(mutex_);
    answered_ = shown_;
  }
  changed_.notify_all();
}

}  // namespace gyre
