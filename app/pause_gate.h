// Holds a thread while the user has paused.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace gyre {

// Any thread.
class PauseGate {
 public:
  void close() { set(true); }
  void open() { set(false); }

  // Returns at once while open; else when it opens or a stop is requested.
  void wait(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, std::move(stop), [this] { return !closed_; });
  }

 private:
  void set(bool closed) {
    {
      const std::lock_guard lock(mutex_);
      closed_ = closed;
    }
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool closed_ = false;
};

}  // namespace gyre
