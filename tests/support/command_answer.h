// The program called as from a shell, in this process.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <stop_token>
#include <string>
#include <vector>

#include "app/cli/command_line.h"

namespace gyre::test {

struct Answer {
  int code = 0;
  std::string out;
  std::string err;
};

inline Answer gyre(const std::vector<std::string>& words, const std::stop_token& stop = {}) {
  std::ostringstream out;
  std::ostringstream err;
  Console console(out, err, ProgressStyle::kLines);
  const int code = runCommandLine(words, console, stop);
  return {code, out.str(), err.str()};
}

}  // namespace gyre::test
