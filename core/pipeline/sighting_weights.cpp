// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/sighting_weights.h"

#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/recover/reprojection.h"

namespace gyre {
namespace {

constexpr double kRoughSigma_px = 0.2;
// Of a two-dimensional normal error of standard deviation 1, half are shorter.
constexpr double kMedianMiss = 1.1774;
constexpr std::size_t kGrain = 64;

std::vector<double> missesOf(const Candidate& candidate, const PointEstimator& estimator,
                             double rough_sigma) {
  const auto known = candidate.estimated ? std::optional(candidate.estimated->position_in_table)
                                         : candidate.roughly_in_table;
  if (!known) return {};
  std::vector<Sighting> alike = candidate.sightings;
  for (Sighting& each : alike) each.sigma = rough_sigma;
  const auto fitted = estimator.refine(alike, *known);
  if (!fitted) return {};
  std::vector<double> misses;
  misses.reserve(alike.size());
  for (const Sighting& each : alike) {
    const auto at = reproject(estimator.poses()[static_cast<std::size_t>(each.view)],
                              each.normalized, fitted->position_in_table);
    if (at) misses.push_back(at->residual.norm());
  }
  return misses;
}

}  // namespace

double sightingScatter(std::span<const Candidate> candidates, const PointEstimator& estimator,
                       double focal_px) {
  std::vector<std::vector<double>> misses(candidates.size());
  parallelFor(candidates.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      misses[i] = missesOf(candidates[i], estimator, kRoughSigma_px / focal_px);
    }
  });
  std::vector<double> all;
  for (const auto& each : misses) all.insert(all.end(), each.begin(), each.end());
  return all.empty() ? 0.0 : median(std::move(all)) / kMedianMiss;
}

}  // namespace gyre
