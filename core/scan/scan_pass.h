// One of several scans of the same object, laid on the table differently each time.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "core/geometry/rigid3.h"

namespace gyre {

// How well a pass fits those it was laid on.
struct PassFit {
  std::size_t spots = 0;     // of the surface, told again in both, that agree
  double spots_mm = 0.0;     // median distance at which these agree
  double overlap = 0.0;      // share of the pass's points that lie on surface another saw, [0, 1]
  double residual_mm = 0.0;  // median distance of these points from it
};

struct ScanPass {
  std::string name;              // "pass-2": of its folder in the merged result
  std::filesystem::path folder;  // the result it was read from; there its pictures are found
  std::size_t views = 0;
  Rigid3 merged_from_pass;     // from the pass's table frame to that of the first pass
  std::optional<PassFit> fit;  // none for the first
};

}  // namespace gyre
