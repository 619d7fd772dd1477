// How far a result lies from a reference.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace gyre {

// Precision: share of the result nearer than d_mm to the reference. Completeness: share of the
// reference nearer than d_mm to the result. f: their harmonic mean. All in [0, 1].
struct ComparisonAt {
  double d_mm = 0.0;
  double precision = 0.0;
  double completeness = 0.0;
  double f = 0.0;
};

struct Comparison {
  double mean_mm = 0.0;  // distances from the result to the reference's surface
  double median_mm = 0.0;
  double p95_mm = 0.0;
  std::size_t samples = 0;
  std::vector<ComparisonAt> at;
};

}  // namespace gyre
