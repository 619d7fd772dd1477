// How a table truly turned during a scan, where markers on its platter told: facts for the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace gyre {

struct TurnedView {
  int view = 0;
  std::string name;         // of the picture's file
  bool seen = false;        // enough markers to tell the angle
  double told_rad = 0.0;    // where the table was told to stand
  double angle_rad = 0.0;   // where it stood; when the markers did not tell, by its neighbours
  double sigma_rad = 0.0;   // one standard deviation of that, when seen
  bool off_course = false;  // further from where it was told to be than any motor errs
};

struct TurningReport {
  std::vector<TurnedView> views;  // in the order in which they came
  double rms_off_rad = 0.0;       // how far the table was from where it was told to be
  double worst_off_rad = 0.0;
  std::string sentence;

  bool lostSteps() const {
    for (const TurnedView& each : views) {
      if (each.off_course) return true;
    }
    return false;
  }
};

}  // namespace gyre
