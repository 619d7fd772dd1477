// All that may be changed about a reconstruction, in one value.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/option_list.h"
#include "core/recover/options.h"
#include "core/track/options.h"

namespace gyre {

// Which recovered points are good enough to be shown and meshed.
struct CloudOptions {
  // Points less certain than this share of the cloud's size are left out.
  double max_sigma_share = 0.004;
  // Reduced chi-square of the agreeing sightings above which a track contradicts itself.
  double max_chi2 = 3.0;
  // Share of the views whose object mask may miss the point.
  double max_outside = 0.08;
  // Points with fewer neighbours than this within 2.5 % of the cloud's size are specks.
  int min_neighbours = 4;
  // Between the features points are grown over the surface, so far apart in the pictures; 0 keeps
  // the features alone.
  double point_spacing_px = 3.0;

  template <class V>
  void describe(V& visit) {
    visit({"max-sigma-share", "", 1e-5, 1, "Largest error bar, as a share of the object's size."},
          max_sigma_share);
    visit({"max-chi2", "", 0.5, 100, "How much a track may contradict itself."}, max_chi2);
    visit({"max-outside", "", 0, 1, "Share of the views in which a point may leave the object."},
          max_outside);
    visit({"min-neighbours", "", 0, 100, "Points with fewer neighbours are specks."},
          min_neighbours);
    visit({"point-spacing", "px", 0, 64, "Distance of the points grown between features; 0: none."},
          point_spacing_px);
  }
  Result<void> validate() const { return validateRanges(*this); }
};

struct ReconstructOptions {
  TrackOptions track;
  RecoverOptions recover;
  CloudOptions cloud;

  template <class V>
  void describe(V& visit) {
    track.describe(visit);
    recover.describe(visit);
    cloud.describe(visit);
  }
  Result<void> validate() const {
    const auto recoverable = recover.validate();  // more than ranges: the solver's name
    return recoverable ? validateRanges(*this) : recoverable;
  }
};

}  // namespace gyre
