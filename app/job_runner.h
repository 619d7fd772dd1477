// One thread that does jobs in turn and tells the window when each is done.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include <QObject>
#include <QString>

#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

// Belongs to the thread that makes it; jobs run in its own. What a job leaves for `done` travels in
// what both capture. The destructor asks the running job to stop and waits for it.
class JobRunner final : public QObject {
  Q_OBJECT

 public:
  using Job = std::function<Result<void>(const Task& task)>;
  using Done = std::function<void(const Result<void>& outcome)>;

  explicit JobRunner(std::string thread_name, QObject* parent = nullptr);
  ~JobRunner() override;

  // done is called in the owner's thread. An exception of the job becomes an Error.
  void start(Job job, Done done);

  // The running job is asked to stop; jobs that wait are dropped and end as cancelled.
  void requestStop();

  // True from start() until the last `done` has been called.
  bool busy() const { return unfinished_ > 0; }

 Q_SIGNALS:
  // At most ten times a second.
  void progressed(double fraction, const QString& stage);
  void idle();  // after the last `done`

 private:
  struct Entry {
    Job job;
    Done done;
    std::stop_source stop;
  };

  void run(const std::stop_token& stop);
  Task taskFor(const Entry& entry);
  void deliver(Done done, Result<void> outcome);

  const std::string thread_name_;
  int unfinished_ = 0;  // of the owner's thread alone

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Entry> waiting_;
  std::stop_source running_;
  std::jthread thread_;  // last: it must stop before the rest goes
};

}  // namespace gyre
