// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/console.h"

#include <cmath>
#include <utility>

#include "core/base/clock.h"

namespace gyre {
namespace {

constexpr double kTerminalInterval_s = 0.1;
constexpr double kLineInterval_s = 5.0;
// An estimate from less than this would jump.
constexpr double kFirstEstimate_s = 2.0;
constexpr double kFirstEstimateFraction = 0.02;

}  // namespace

std::string timeLeftText(double fraction, double elapsed_s) {
  if (elapsed_s < kFirstEstimate_s || fraction < kFirstEstimateFraction || fraction >= 1.0) {
    return "";
  }
  const double left_s = elapsed_s * (1.0 - fraction) / fraction;
  if (left_s < 90.0) return std::to_string(std::lround(std::ceil(left_s))) + " s left";
  return std::to_string(std::lround(left_s / 60.0)) + " min left";
}

Console::Console(std::ostream& out, std::ostream& err, ProgressStyle style)
    : out_(out), err_(err), style_(style) {}

Task Console::task(std::stop_token stop_token) {
  const std::scoped_lock lock(mutex_);
  start_s_ = steadySeconds();
  printed_s_ = start_s_;
  return Task(std::move(stop_token),
              [this](double fraction, std::string_view stage) { progress(fraction, stage); });
}

void Console::progress(double fraction, std::string_view stage) {
  if (verbosity_ == Verbosity::kQuiet) return;
  const std::scoped_lock lock(mutex_);
  const double now_s = steadySeconds();
  const bool terminal = style_ == ProgressStyle::kTerminal;
  if (now_s - printed_s_ < (terminal ? kTerminalInterval_s : kLineInterval_s)) return;
  printed_s_ = now_s;
  std::string line(stage);
  line += " (" + std::to_string(std::lround(100.0 * fraction)) + " %)";
  const std::string left = timeLeftText(fraction, now_s - start_s_);
  if (!left.empty()) line += ", " + left;
  if (terminal) {
    err_ << '\r' << line << "\x1b[K" << std::flush;
    line_open_ = true;
  } else {
    err_ << line << std::endl;
  }
}

void Console::clearProgress() {
  if (line_open_) err_ << "\r\x1b[K";
  line_open_ = false;
}

void Console::printLine(std::ostream& stream, std::string_view line) {
  const std::scoped_lock lock(mutex_);
  clearProgress();
  stream << line << std::endl;
}

void Console::say(std::string_view line) {
  if (verbosity_ != Verbosity::kQuiet) printLine(out_, line);
}

void Console::sayAlways(std::string_view text) { printLine(out_, text); }

void Console::note(std::string_view line) {
  if (verbosity_ == Verbosity::kVerbose) printLine(err_, line);
}

void Console::warn(std::string_view line) { printLine(err_, line); }

int Console::fail(const Error& error) {
  printLine(err_, error.sentence());
  return error.code == Error::Code::kCancelled ? kStopped : kFailed;
}

int Console::wrongUse(const Error& error) {
  printLine(err_, error.sentence());
  return kWrongUse;
}

}  // namespace gyre
