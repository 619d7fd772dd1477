// Whether camera or table were bumped during a scan: facts for the user and the report.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace gyre {

// What stands still around the table, in one view against the first one; or what lies on the
// platter, against where the table's turning has it.
struct ViewDrift {
  int view = 0;
  bool judged = false;    // enough of it was seen to tell
  double px = 0.0;        // how far it moved, rms over the picture
  double sigma_px = 0.0;  // one standard deviation of that
  bool moved = false;     // beyond doubt, and by enough to matter
};

struct DriftReport {
  std::vector<ViewDrift> views;    // in the order in which they came
  std::vector<ViewDrift> platter;  // likewise by its ring of markers; empty where there is none
  std::string sentence;            // what they say together; empty before the second view

  // The first view in which anything moved, or null. Points into views or platter.
  const ViewDrift* firstMoved() const {
    const ViewDrift* first = nullptr;
    for (const auto* list : {&views, &platter}) {
      for (const ViewDrift& each : *list) {
        if (each.moved && (first == nullptr || each.view < first->view)) first = &each;
      }
    }
    return first;
  }
};

}  // namespace gyre
