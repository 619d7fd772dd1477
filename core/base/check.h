// GYRE_CHECK ends the program when the code itself is wrong. For a world that fails: result.h.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre::internal {
[[noreturn]] void checkFailed(const char* condition, const char* file, int line) noexcept;
}  // namespace gyre::internal

// Ends the program, in every build, with the condition, file and line on standard error.
#define GYRE_CHECK(condition)                          \
  (static_cast<bool>(condition) ? static_cast<void>(0) \
                                : ::gyre::internal::checkFailed(#condition, __FILE__, __LINE__))
