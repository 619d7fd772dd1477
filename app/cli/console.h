// What a command says: results on standard output, progress and troubles on standard error.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <mutex>
#include <ostream>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

enum class Verbosity : std::uint8_t { kQuiet, kNormal, kVerbose };

// How people are told how far it is: a line that rewrites itself, or for files a line now and then.
enum class ProgressStyle : std::uint8_t { kTerminal, kLines };

// The exit codes of every command.
enum ExitCode : int { kDone = 0, kFailed = 1, kWrongUse = 2, kStopped = 130 };

// Any thread.
class Console {
 public:
  Console(std::ostream& out, std::ostream& err, ProgressStyle style);

  void setVerbosity(Verbosity verbosity) { verbosity_ = verbosity; }

  // A task whose reports become the progress line, with the time left.
  Task task(std::stop_token stop_token);

  void say(std::string_view line);        // a result; nothing when quiet
  void sayAlways(std::string_view text);  // what was asked for by --json: quiet or not
  void note(std::string_view line);       // a detail; only when verbose
  void warn(std::string_view line);       // what went wrong without ending the command

  // Ends the progress line, says what happened and what to try, and gives the exit code.
  int fail(const Error& error);
  int wrongUse(const Error& error);

 private:
  void progress(double fraction, std::string_view stage);
  void clearProgress();
  void printLine(std::ostream& stream, std::string_view line);

  std::ostream& out_;
  std::ostream& err_;
  const ProgressStyle style_;
  Verbosity verbosity_ = Verbosity::kNormal;

  std::mutex mutex_;
  double start_s_ = 0.0;    // of the present task
  double printed_s_ = 0.0;  // when progress was last shown
  bool line_open_ = false;  // a progress line stands unfinished on the terminal
};

// "about 2 min left", or nothing while too little is known to say it.
std::string timeLeftText(double fraction, double elapsed_s);

}  // namespace gyre
