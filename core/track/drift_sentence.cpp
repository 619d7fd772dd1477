// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/drift_sentence.h"

#include <algorithm>

#include "core/base/formatted.h"

namespace gyre {
namespace {

std::string viewText(const ViewDrift& drift) { return std::to_string(drift.view + 1); }

// What moved, from where on, and whether the last views are back.
std::string movedText(const std::vector<ViewDrift>& views) {
  const auto moved = [](const ViewDrift& drift) { return drift.moved; };
  const auto first = std::find_if(views.begin(), views.end(), moved);
  const auto last = std::find_if(views.rbegin(), views.rend(), moved);
  const double most_px =
      std::max_element(views.begin(), views.end(), [&](const auto& a, const auto& b) {
        return (a.moved ? a.px : 0.0) < (b.moved ? b.px : 0.0);
      })->px;
  const bool back =
      std::any_of(views.rbegin(), last, [](const auto& drift) { return drift.judged; });
  std::string text = "The camera was bumped, or the table with it: from view " + viewText(*first) +
                     " on, all that stands still is up to " + pxText(most_px) + " off";
  if (back) text += ", until view " + viewText(*last) + ", after which it is back";
  return text + ". Fix camera and table, then scan again; if they stay where they are now, " +
         "calibrate again first.";
}

}  // namespace

std::string driftSentence(const std::vector<ViewDrift>& views, double least_px) {
  const auto judged = static_cast<std::size_t>(
      std::count_if(views.begin(), views.end(), [](const auto& drift) { return drift.judged; }));
  if (std::any_of(views.begin(), views.end(), [](const auto& drift) { return drift.moved; })) {
    return movedText(views);
  }
  // The first view is held against itself, which says nothing.
  if (judged < 2) {
    return "Whether the camera was bumped cannot be told: too little stands still in the picture "
           "that has texture. Put something printed behind the table, where the camera sees it.";
  }
  std::string text = "The camera stood still: what stands still is nowhere more than " +
                     pxText(least_px) + " off.";
  if (const std::size_t covered = views.size() - judged; covered > 0) {
    text += " In " + std::to_string(covered) + " of " + std::to_string(views.size()) +
            " views it was covered, and nothing can be said.";
  }
  return text;
}

}  // namespace gyre
