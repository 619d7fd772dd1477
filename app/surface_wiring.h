// Wires what is done to a surface: making, cleaning, undoing, measuring, exporting.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

class MeasureController;
class ScanController;
class WorkPage;

// All three outlive the wires.
void wireSurface(WorkPage& page, ScanController& scans, MeasureController& measures);

}  // namespace gyre
