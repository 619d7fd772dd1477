// Starts Gyre: with words a command, without words the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/stop_signals.h"

int main(int argc, char** argv) {
  const gyre::StopSignals signals;
  const auto style =
      isatty(STDERR_FILENO) != 0 ? gyre::ProgressStyle::kTerminal : gyre::ProgressStyle::kLines;
  gyre::Console console(std::cout, std::cerr, style);
  return gyre::runCommandLine(std::vector<std::string>(argv + 1, argv + argc), console,
                              signals.token());
}
