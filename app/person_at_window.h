// Asks the person before the window to turn a table by hand.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include <QObject>

#include "core/device/hand_turntable.h"
#include "ui/facts.h"

namespace gyre {

// Belongs to the window's thread. It must outlive every table that asks through it.
class PersonAtWindow final : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  // For RigOptions. Called in the table's thread, it waits there for done() or for a stop.
  AskPerson ask();

 public Q_SLOTS:
  void done();  // the table stands where asked() wants it

 Q_SIGNALS:
  void asked(const gyre::HandTurnFacts& turn);
  void settled();  // what was asked is done, or is wanted no more

 private:
  Result<void> await(const HandTurn& turn, const Task& task);

  std::int64_t shown_ = 0;  // the number of the newest question that the window has shown
  std::mutex mutex_;        // guards the rest
  std::condition_variable_any changed_;
  std::int64_t asked_ = 0;
  std::int64_t answered_ = 0;
};

}  // namespace gyre
