// Whether camera or table were bumped during a scan: facts for the user and the report.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace gyre {

// What stands still around the table, in one view against the first one.
struct ViewDrift {
  int view = 0;
  bool judged = false;    // enough of it was seen to tell
  double px = 0.0;        // how far it moved, rms over the picture
  double sigma_px = 0.0;  // one standard deviation of that
  bool moved = false;     // beyond doubt, and by enough to matter
};

struct DriftReport {
  std::vector<ViewDrift> views;  // in the order in which they came
  std::string sentence;          // what they say together; empty before the second view

  // The first view that moved, or null. Points into views.
  const ViewDrift* firstMoved() const {
    for (const ViewDrift& each : views) {
      if (each.moved) return &each;
    }
    return nullptr;
  }
};

}  // namespace gyre
