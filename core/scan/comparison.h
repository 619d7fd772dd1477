// How far a result lies from a reference.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/rigid3.h"

namespace gyre {

// Precision: share of the result nearer than d_mm to the reference. Completeness: share of the
// reference nearer than d_mm to the result. f: their harmonic mean. All in [0, 1].
struct ComparisonAt {
  double d_mm = 0.0;
  double precision = 0.0;
  double completeness = 0.0;
  double f = 0.0;
};

// The share of all distances from from_mm up to to_mm.
struct ComparisonBin {
  double from_mm = 0.0;
  double to_mm = 0.0;
  double share = 0.0;
};

struct Comparison {
  double mean_mm = 0.0;  // distances from the result to the reference's surface
  double median_mm = 0.0;
  double p95_mm = 0.0;
  std::size_t samples = 0;
  double max_mm = 0.0;
  std::vector<ComparisonAt> at;
  // 40 bins of one width up to scale_mm, and one for all above where there are any. Shares add up
  // to 1.
  std::vector<ComparisonBin> histogram;
  double scale_mm = 0.0;         // by itself a round number that 99 % of them do not exceed
  Rigid3 reference_from_result;  // how the result was moved to fit; identity when it was not
};

}  // namespace gyre
