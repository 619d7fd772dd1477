// What may be changed about the recovery of points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/option_list.h"

namespace gyre {

struct RecoverOptions {
  // How a point is found from its rays: see Solver. The paper's ways believe every sighting.
  std::string solver = "robust";
  // Widest angle between two rays below which depth is guesswork.
  double min_parallax_deg = 5.0;
  // Fewest views that must agree on a point.
  int min_views = 3;
  // Smallest share of a track's sightings that must agree on its point.
  double min_agreeing = 0.7;
  // A sighting further from the point's projection than this does not agree. In its own standard
  // deviations; 3.03 keeps 99 % of a two-dimensional normal distribution.
  double outlier_sigma = 3.03;
  // Standard deviation of the table's angle in one view: it loosens the sightings across the
  // motion, so that the error bars are true. Zero for a perfect motor.
  double angle_sigma_deg = 0.03;
  // How far from where it was told the table may be found to stand, by all features together, as a
  // standard deviation. Zero believes the motor.
  double angle_freedom_deg = 0.1;
  // The same for all steps alike being too long or too short, relative.
  double scale_freedom = 0.02;

  template <class V>
  void describe(V& visit) {
    visit({"solver", "", 0, 0, "How points are found: two-view, squared, absolute or robust."},
          solver);
    visit({"min-parallax", "deg", 0.1, 90, "Widest angle between two rays that a point needs."},
          min_parallax_deg);
    visit({"min-views", "", 2, 100, "Fewest views that must agree on a point."}, min_views);
    visit({"min-agreeing", "", 0.1, 1, "Share of a track's sightings that must agree."},
          min_agreeing);
    visit({"outlier-sigma", "sigma", 1, 20, "How far off a sighting still agrees."}, outlier_sigma);
    visit({"angle-sigma", "deg", 0, 5, "Expected error of the table's angle in one view."},
          angle_sigma_deg);
    visit({"angle-freedom", "deg", 0, 5, "How far off the table may be found to stand."},
          angle_freedom_deg);
    visit({"scale-freedom", "", 0, 0.2, "How much too far the table may be found to turn."},
          scale_freedom);
  }
  Result<void> validate() const;
};

}  // namespace gyre
