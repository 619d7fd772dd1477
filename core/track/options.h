// What may be changed about the tracking of features.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/option_list.h"

namespace gyre {

struct TrackOptions {
  // Distance between neighbouring features. Smaller gives more points and costs more time.
  int feature_spacing_px = 8;
  // Side of the square that is compared between views; odd.
  int window_px = 15;
  // A feature whose texture would locate it worse than this is not followed.
  double max_sigma_px = 0.2;
  // Features nearer than this to the object's outline are ignored: smooth outlines slide over the
  // surface (the paper's boundary rule).
  double silhouette_margin_px = 10.0;
  // Tracking there and back again must end within this distance of the start.
  double max_round_trip_px = 0.5;
  // A sighting may lie at most this far off what the table's turning allows.
  double max_epipolar_px = 1.5;
  // The least normalised correlation between the patches of neighbouring views.
  double min_correlation = 0.8;
  // Points lower than this above the platter are taken for the platter's own texture.
  double min_height_mm = 1.0;
  // In so many views, spread evenly among those that face it, a point is looked for at the end.
  int most_views = 60;

  template <class V>
  void describe(V& visit) {
    visit({"feature-spacing", "px", 3, 64, "Distance between neighbouring features."},
          feature_spacing_px);
    visit({"window", "px", 7, 41, "Side of the square compared between views."}, window_px);
    visit({"max-sigma", "px", 0.01, 2, "How badly located a feature may be."}, max_sigma_px);
    visit({"silhouette-margin", "px", 0, 64, "Features nearer to the outline are ignored."},
          silhouette_margin_px);
    visit({"max-round-trip", "px", 0.05, 5, "Tracking there and back must end this near."},
          max_round_trip_px);
    visit({"max-epipolar", "px", 0.1, 10, "How far off the turning motion a sighting may lie."},
          max_epipolar_px);
    visit({"min-correlation", "", 0, 0.999, "Least correlation between neighbouring views."},
          min_correlation);
    visit({"min-height", "mm", -10, 100, "Points below this height are platter."}, min_height_mm);
    visit({"most-views", "", 3, 100000, "Views in which a point is looked for at the end."},
          most_views);
  }
  Result<void> validate() const { return validateRanges(*this); }
};

}  // namespace gyre
