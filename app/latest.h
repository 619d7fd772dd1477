// A box for one value in which the newest wins: what nobody fetched in time is dropped.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace gyre {

// Any thread may put and take.
template <class T>
class Latest {
 public:
  // True when the box was empty: the reader must then be told once.
  [[nodiscard]] bool put(T value) {
    const std::lock_guard lock(mutex_);
    const bool was_empty = !value_.has_value();
    value_ = std::move(value);
    return was_empty;
  }

  // The newest value, or nothing when none came since the last time.
  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<T> value_;
};

}  // namespace gyre
