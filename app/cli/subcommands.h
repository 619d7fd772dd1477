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

// Each adds one subcommand to app; when the words name it, `chosen` becomes what to run.
void addBundle(CLI::App& app, Run& chosen);
void addCalibrate(CLI::App& app, Run& chosen);
void addCompare(CLI::App& app, Run& chosen);
void addDemo(CLI::App& app, Run& chosen);
void addDevices(CLI::App& app, Run& chosen);
void addExport(CLI::App& app, Run& chosen);
void addMeasure(CLI::App& app, Run& chosen);
void addMerge(CLI::App& app, Run& chosen);
void addMesh(CLI::App& app, Run& chosen);
void addPrintTarget(CLI::App& app, Run& chosen);
void addReconstruct(CLI::App& app, Run& chosen);
void addReport(CLI::App& app, Run& chosen);
void addReproduce(CLI::App& app, Run& chosen);
void addResume(CLI::App& app, Run& chosen);
void addScan(CLI::App& app, Run& chosen);
void addSimFirmware(CLI::App& app, Run& chosen);

}  // namespace gyre
