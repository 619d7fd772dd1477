// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/step_scale.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/calib/rig/axis_from_poses.h"

namespace gyre {
namespace {

constexpr double kGridPhase_rad = 0.2;    // by how much the last angle moves between candidates
constexpr double kMostCandidates = 2e5;   // for commands over thousands of turns
constexpr double kOutlier_rad = 0.5;      // an angle further off is as wrong as any
constexpr double kAsTold = 0.05;          // a ratio this near to 1 does what it is told
constexpr double kAsGood = 1.5;           // costs within this factor of the best, and
constexpr double kAsGoodRms_rad = 0.005;  // within this of it, are as good

struct Pair {
  double commanded_rad;
  double seen_rad;
};

// The common offset is the motor's error in the first picture; its circular mean takes it out.
double costOf(const std::vector<Pair>& pairs, double scale) {
  double x = 0.0;
  double y = 0.0;
  for (const Pair& pair : pairs) {
    const double off_rad = pair.seen_rad - scale * pair.commanded_rad;
    x += std::cos(off_rad);
    y += std::sin(off_rad);
  }
  const double offset_rad = std::atan2(y, x);
  double sum = 0.0;
  for (const Pair& pair : pairs) {
    const double off_rad = wrapped(pair.seen_rad - scale * pair.commanded_rad - offset_rad);
    sum += std::min(off_rad * off_rad, kOutlier_rad * kOutlier_rad);
  }
  return sum / static_cast<double>(pairs.size());
}

// Among ratios that explain the angles equally well: about 1 first, then the least motion, forwards
// before backwards.
double oddness(double scale) {
  if (std::abs(scale - 1.0) < kAsTold) return 0.0;
  return std::abs(scale) + (scale < 0.0 ? 1e-6 : 0.0);
}

// Narrows the interval around a candidate to its lowest point (golden section).
double refined(const std::vector<Pair>& pairs, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  for (int iteration = 0; iteration < 40; ++iteration) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    (costOf(pairs, a) < costOf(pairs, b) ? high : low) =
        costOf(pairs, a) < costOf(pairs, b) ? b : a;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<double> stepScaleFrom(const std::vector<std::optional<double>>& commanded_rad,
                                    const std::vector<std::optional<double>>& seen_rad) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < commanded_rad.size() && k < seen_rad.size(); ++k) {
    if (commanded_rad[k] && seen_rad[k]) pairs.push_back({*commanded_rad[k], *seen_rad[k]});
  }
  if (pairs.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(
      pairs.begin(), pairs.end(),
      [](const Pair& a, const Pair& b) { return a.commanded_rad < b.commanded_rad; });
  const double span_rad = most->commanded_rad - least->commanded_rad;
  if (!(span_rad > 0.0)) return std::nullopt;

  const double step = std::max({kGridPhase_rad / span_rad, 2.0 * kMostStepScale / kMostCandidates});
  struct Candidate {
    double scale;
    double cost;
  };
  std::vector<Candidate> candidates;
  const int count = static_cast<int>(2.0 * kMostStepScale / step) + 2;
  candidates.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double scale = -kMostStepScale + i * step;
    candidates.push_back({scale, costOf(pairs, scale)});
  }
  std::vector<Candidate> minima;
  for (std::size_t i = 1; i + 1 < candidates.size(); ++i) {
    if (candidates[i].cost > candidates[i - 1].cost ||
        candidates[i].cost > candidates[i + 1].cost) {
      continue;
    }
    const double scale = refined(pairs, candidates[i - 1].scale, candidates[i + 1].scale);
    if (std::abs(scale) < kLeastStepScale / 2.0) continue;
    minima.push_back({scale, costOf(pairs, scale)});
  }
  if (minima.empty()) return std::nullopt;
  const double best = std::min_element(minima.begin(), minima.end(), [](auto& a, auto& b) {
                        return a.cost < b.cost;
                      })->cost;
  const double enough = kAsGood * best + kAsGoodRms_rad * kAsGoodRms_rad;
  std::optional<double> found;
  for (const Candidate& minimum : minima) {
    if (minimum.cost > enough) continue;
    if (!found || oddness(minimum.scale) < oddness(*found)) found = minimum.scale;
  }
  return found;
}

std::vector<double> unwrappedAngles(const std::vector<std::optional<double>>& commanded_rad,
                                    const std::vector<std::optional<double>>& seen_rad,
                                    double step_scale) {
  std::vector<double> angles(seen_rad.size(), 0.0);
  double before_rad = 0.0;
  for (std::size_t k = 0; k < seen_rad.size(); ++k) {
    const double expected_rad = commanded_rad[k] ? step_scale * *commanded_rad[k] : before_rad;
    angles[k] = expected_rad;
    if (seen_rad[k]) angles[k] += wrapped(*seen_rad[k] - expected_rad);
    if (!commanded_rad[k] && !seen_rad[k]) angles[k] = 0.0;
    before_rad = angles[k];
  }
  return angles;
}

}  // namespace gyre
