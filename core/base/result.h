// A value, or the reason why there is none, in words for the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/check.h"

namespace gyre {

// Why something in the world failed. Both texts are shown to people as they stand.
struct Error {
  enum class Code {
    kCancelled,     // the user stopped it; never shown as a failure
    kInvalidInput,  // a file, an option or a picture is not what it must be
    kNotFound,      // no such file, port or camera
    kNoPermission,
    kBusy,         // another program holds it
    kTimeout,      // no answer before the deadline
    kGone,         // a device vanished while in use
    kWrongDevice,  // something answered, but not what was expected
    kRejected,     // the device understood and refused
    kAlarm,        // the device stopped by itself; its position may be lost
    kIo,           // reading or writing failed
    kNoSpace,      // the disk is full
    kTooFew,       // the data do not suffice for a result
    kInternal,     // an exception of a library that nothing above explains
  };

  Code code = Code::kInternal;
  std::string what;    // what happened: one sentence, with its full stop
  std::string advice;  // what to try: one sentence or none

  // Both sentences in one line.
  std::string sentence() const { return advice.empty() ? what : what + " " + advice; }
};

// Either a T or an Error. Asking for the one that is not there ends the program.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(*-explicit-*)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(*-explicit-*)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    GYRE_CHECK(ok());
    return std::get<0>(state_);
  }
  T& value() & {
    GYRE_CHECK(ok());
    return std::get<0>(state_);
  }
  T&& value() && {
    GYRE_CHECK(ok());
    return std::get<0>(std::move(state_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  const Error& error() const {
    GYRE_CHECK(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

// Success without a value, or an Error. `return {};` means success.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT(*-explicit-*)

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const {
    GYRE_CHECK(!ok());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

// The error every cancelled job returns.
inline Error cancelled() { return {Error::Code::kCancelled, "Stopped.", ""}; }

}  // namespace gyre
