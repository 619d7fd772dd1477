// How long work says how far it is, and hears that it shall stop.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "core/base/result.h"

namespace gyre {

// Handed down as the last parameter of anything that takes more than 100 ms. Cheap to copy.
// Any thread may report or ask; the reporter is called in the thread that reports.
class Task {
 public:
  // Gets the fraction done in [0, 1] and what is being done, in words for the user.
  using Reporter = std::function<void(double fraction, std::string_view stage)>;

  // The silent task that nobody stops: for tests and for work nobody waits for.
  Task() = default;
  explicit Task(std::stop_token stop_token, Reporter reporter = {});

  void report(double fraction, std::string_view stage) const;
  bool stopRequested() const { return stop_token_.stop_requested(); }
  std::stop_token stopToken() const { return stop_token_; }

  // A task whose 0..1 is [from, to] of this one, with the same stop token.
  Task part(double from, double to) const;

  // Sleeps, at most until a stop is requested. Returns false when it was.
  [[nodiscard]] bool sleepFor(double seconds) const;

 private:
  std::stop_token stop_token_;
  Reporter reporter_;
  double from_ = 0.0;
  double to_ = 1.0;
};

}  // namespace gyre
