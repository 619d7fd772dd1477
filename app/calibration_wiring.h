// Joins the calibration wizard's wishes to what does them, and the facts to the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

class CalibrationController;
class ScanController;
class WorkPage;

// All three outlive the connections. scans: gets the calibration that is kept.
void wireCalibration(WorkPage& page, CalibrationController& calibrations, ScanController& scans);

}  // namespace gyre
