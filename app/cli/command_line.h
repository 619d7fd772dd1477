// The program without a window: words in, exit code out.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ostream>
#include <stop_token>
#include <string>
#include <vector>

#include "app/cli/console.h"

namespace gyre {

// Runs the subcommand that the words name (without the program's name). Exit codes as Console has
// them; wrong words give 2 and a sentence.
int runCommandLine(std::vector<std::string> words, Console& console, std::stop_token stop_token);

}  // namespace gyre
