// Wires the step in which the object is placed: what may be taken, looked at and drawn there.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

class ScanController;
class WorkPage;

void wirePlace(WorkPage& page, ScanController& scans);

}  // namespace gyre
