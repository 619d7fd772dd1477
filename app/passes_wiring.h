// Wires what the window offers for several passes of one object to the scan controller.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

class MainWindow;
class ScanController;

// Both must outlive the window.
void wirePasses(MainWindow& window, ScanController& scans);

}  // namespace gyre
