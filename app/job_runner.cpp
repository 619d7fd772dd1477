// One thread that does jobs in turn and tells the window when each is done.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/job_runner.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <memory>
#include <new>
#include <utility>

#include <QPointer>

#include "core/base/clock.h"

namespace gyre {
namespace {

constexpr double kReportInterval_s = 0.1;
constexpr int kBelowWindow = 10;  // nice

Result<void> runGuarded(const JobRunner::Job& job, const Task& task) try {
  return job(task);
} catch (const std::bad_alloc&) {
  return Error{Error::Code::kInternal, "The memory of this computer does not suffice.",
               "Close other programs, or use fewer or smaller pictures."};
} catch (const std::exception& problem) {
  return Error{Error::Code::kInternal,
               std::string("Something failed inside: ") + problem.what() + ".",
               "Please report it with the log."};
}

}  // namespace

JobRunner::JobRunner(std::string thread_name, QObject* parent)
    : QObject(parent),
      thread_name_(std::move(thread_name)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

JobRunner::~JobRunner() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    running_.request_stop();
  }
  thread_.request_stop();
}

void JobRunner::start(Job job, Done done) {
  ++unfinished_;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(job), std::move(done), {}});
  }
  changed_.notify_all();
}

void JobRunner::requestStop() {
  std::deque<Entry> dropped;
  {
    const std::lock_guard lock(mutex_);
    running_.request_stop();
    std::swap(dropped, waiting_);
  }
  for (Entry& entry : dropped) deliver(std::move(entry.done), cancelled());
}

void JobRunner::run(const std::stop_token& stop) {
  // Below the window's thread, for this one and those it starts: the window stays alive.
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kBelowWindow);
  pthread_setname_np(pthread_self(), thread_name_.substr(0, 15).c_str());
  for (;;) {
    Entry entry;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) return;
      entry = std::move(waiting_.front());
      waiting_.pop_front();
      running_ = entry.stop;
    }
    Result<void> outcome = runGuarded(entry.job, taskFor(entry));
    entry.job = nullptr;  // what it captured goes here, not in the window's thread
    deliver(std::move(entry.done), std::move(outcome));
  }
}

Task JobRunner::taskFor(const Entry& entry) {
  auto last_s = std::make_shared<double>(0.0);
  auto reporting = std::make_shared<std::mutex>();  // a job may report from several threads
  return Task(entry.stop.get_token(), [this, last_s, reporting](double fraction,
                                                                std::string_view stage) {
    const std::lock_guard lock(*reporting);
    const double now_s = steadySeconds();
    if (now_s - *last_s < kReportInterval_s) return;
    *last_s = now_s;
    Q_EMIT progressed(fraction, QString::fromUtf8(stage.data(), static_cast<int>(stage.size())));
  });
}

void JobRunner::deliver(Done done, Result<void> outcome) {
  QMetaObject::invokeMethod(
      this,
      [this, done = std::move(done), outcome = std::move(outcome)] {
        const QPointer<JobRunner> alive(this);
        done(outcome);  // may start the next job
        if (!alive) return;
        if (--unfinished_ == 0) Q_EMIT idle();
      },
      Qt::QueuedConnection);
}

}  // namespace gyre
