// The subcommands: each declares its words and leaves what to run when they were given.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "app/cli/console.h"
#include "core/base/task.h"

namespace CLI {
class App;
}

namespace gyre {

// Runs a subcommand with its parsed words and gives its exit code.
using Run = std::function<int(Console& console, const Task& task)>;

}  // namespace gyre
