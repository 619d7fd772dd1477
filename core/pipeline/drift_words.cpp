// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/drift_words.h"

#include <algorithm>
#include <string>

#include "core/base/formatted.h"

namespace gyre {
namespace {

bool hasMoved(const std::vector<ViewDrift>& views) {
  return std::any_of(views.begin(), views.end(), [](const auto& each) { return each.moved; });
}

long judgedCount(const std::vector<ViewDrift>& views) {
  return std::count_if(views.begin(), views.end(), [](const auto& each) { return each.judged; });
}

std::string pushedText(const std::vector<ViewDrift>& platter, bool background_stood_still) {
  int first = -1;
  double most_px = 0.0;
  for (const ViewDrift& each : platter) {
    if (!each.moved) continue;
    if (first < 0) first = each.view;
    most_px = std::max(most_px, each.px);
  }
  const std::string what = background_stood_still
                               ? "The turntable was pushed: from view "
                               : "The turntable was pushed or the camera bumped: from view ";
  return what + std::to_string(first + 1) + " on, the markers on its platter are up to " +
         pxText(most_px) + " off where its turning has them" +
         (background_stood_still ? ", while all around stands still" : "") +
         ". Fix camera and table, then scan again; if they stay where they are now, calibrate "
         "again first.";
}

}  // namespace

void addPlatter(DriftReport& report, const std::vector<ViewDrift>& platter) {
  report.platter = platter;
  // The first view is held against itself by the background, which says nothing.
  const bool background_judged = judgedCount(report.views) >= 2;
  const long seen = judgedCount(platter);
  if (seen == 0 || hasMoved(report.views)) return;
  if (hasMoved(platter)) {
    report.sentence = pushedText(platter, background_judged);
  } else if (background_judged) {
    report.sentence += " So did the turntable, by the markers on its platter.";
  } else {
    report.sentence = "Camera and turntable stood still, by the markers on the platter in " +
                      std::to_string(seen) + " of " + std::to_string(platter.size()) + " views.";
  }
}

}  // namespace gyre
