// Finds out whether a GRBL board is at the other end, without moving anything.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "core/base/result.h"
#include "core/device/protocols/grbl_link.h"

namespace gyre {

struct GrblBoardInfo {
  std::string firmware;            // "Grbl 1.1h"
  std::map<int, double> settings;  // $N, as read twice with the same result
};

// Waits up to greeting_s for the greeting of a board that restarts when its port is opened, then
// asks: ? first, since a board that moves belongs to somebody else (kBusy), then a soft reset. Then
// $I, $$. kWrongDevice when something else answers, or a GRBL older than 1.1; kTimeout when nothing
// does.
Result<GrblBoardInfo> identifyGrbl(GrblLink& link, double greeting_s,
                                   const Interrupted& interrupted);

}  // namespace gyre
