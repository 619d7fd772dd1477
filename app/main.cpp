// Starts Gyre: with words a command, without words the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/stop_signals.h"
#include "app/gui.h"
#include "app/gui_words.h"

int main(int argc, char** argv) {
  const gyre::StopSignals signals;
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (auto window = gyre::guiOptions(words)) {
    window->stop = signals.token();
    return gyre::runGui(argc, argv, *window);
  }
  const auto style =
      isatty(STDERR_FILENO) != 0 ? gyre::ProgressStyle::kTerminal : gyre::ProgressStyle::kLines;
  gyre::Console console(std::cout, std::cerr, style);
  return gyre::runCommandLine(words, console, signals.token());
}
