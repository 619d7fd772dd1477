// How demo, scan and resume tell their end.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "app/cli/console.h"
#include "app/rig.h"
#include "app/scan_files.h"
#include "app/scan_run.h"

namespace gyre {

// Says what the scan gave: points, error bars, mesh.
void tellResults(Console& console, const Reconstruction& reconstruction,
                 const WrittenResults& written);

// Says what turntable and camera are, what hinders them, and what could not be locked.
void tellDevices(Console& console, Rig& rig);

// From the points, or why there are none, to the exit code: writes the files and tells the end.
int endScan(Console& console, const ScanStore& store, const Result<Reconstruction>& reconstruction,
            const Task& task);

// Says why the scan ended early, what is kept, and how it goes on. Gives the exit code.
int failScan(Console& console, const ScanStore& store, const Error& error);

// Tells what is remarked while a scan is taken, as it happens.
ScanObserver remarksTo(Console& console);

// "42 s", "2 min 5 s".
std::string secondsText(double seconds);

}  // namespace gyre
