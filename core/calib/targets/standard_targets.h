// The calibration targets that people can print: what is known of them, and their nets on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/calib/targets/print_drawing.h"
#include "core/scan/target.h"

namespace gyre {

struct StandardTarget {
  Target target;                   // target.name is the name it is asked for by
  std::string title;               // a few words for people
  std::string purpose;             // one sentence: when to take this one
  std::vector<std::string> steps;  // how to make it from the sheet, a sentence each
  PrintDrawing net;                // the parts at true size, without titles and rulers
};

// cube, wedge, coded-cube, flat, ring (120 mm), ring-100, ring-140, ring-160.
const std::vector<std::string>& standardTargetNames();

// All stand centred on the axis of their frame and fit a platter of 120 mm (the larger rings: one
// of their diameter). All coded ones share DICT_5X5_250 with no id twice, so that none is taken for
// another. Fails with a sentence that lists the names when there is none of this name.
Result<StandardTarget> standardTarget(const std::string& name);

}  // namespace gyre
