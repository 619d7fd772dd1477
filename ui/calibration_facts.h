// What the calibration wizard is told and what it asks for: plain facts and choices.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QString>

namespace gyre {

// How sharp and how bright the live picture is.
struct FocusFacts {
  double sharpness = 0.0;   // as a share of the sharpest moment since the page was opened, [0, 1]
  double too_bright = 0.0;  // share of pixels without detail because they are white, [0, 1]
  double too_dark = 0.0;    // share of pixels without detail because they are black, [0, 1]
  QString advice;           // one sentence; empty when all is well
};

// A target to choose from.
struct TargetOffer {
  QString word;   // built-in name
  QString title;  // for people
  QString about;  // for whom it is, one sentence
};

// What stands on the table, and what a caliper said of its rulers.
struct TargetChoice {
  QString word;  // built-in name, or the path of a TARGET.json
  std::optional<double> ruler_right_mm;
  std::optional<double> ruler_down_mm;
  bool keep_lens = false;  // only the camera's place is measured; its lens is known

  bool operator==(const TargetChoice&) const = default;
};

}  // namespace gyre
