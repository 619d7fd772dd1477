// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/solved_turning.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/base/units.h"

namespace gyre {
namespace {

// Coarser than this, the motor's own count is the better angle.
constexpr double kMostSigma_rad = radFromDeg(0.05);

}  // namespace

AngleBeliefs beliefsBeforeSolving(std::span<const TurnedView> views,
                                  const RecoverOptions& options) {
  AngleBeliefs beliefs;
  beliefs.scale_sigma = options.scale_freedom;
  for (const TurnedView& view : views) {
    const bool first = beliefs.expected_sigma_rad.empty();
    beliefs.expected_sigma_rad.push_back(first       ? 0.0
                                         : view.seen ? view.sigma_rad
                                                     : radFromDeg(options.angle_sigma_deg));
    beliefs.prior_sigma_rad.push_back(first       ? 0.0
                                      : view.seen ? view.sigma_rad
                                                  : radFromDeg(options.angle_freedom_deg));
    beliefs.turned_rad.push_back(view.seen ? 0.0 : view.told_rad - views.front().told_rad);
  }
  return beliefs;
}

TurningReport afterSolving(TurningReport before, const TurnEstimate& solved) {
  GYRE_CHECK(before.views.size() == solved.corrections_rad.size());
  TurningReport report = std::move(before);
  double squares = 0.0;
  report.worst_off_rad = 0.0;
  for (std::size_t i = 0; i < report.views.size(); ++i) {
    TurnedView& view = report.views[i];
    view.angle_rad += solved.corrections_rad[i];
    view.sigma_rad = solved.sigma_rad[i];
    view.seen = view.seen || view.sigma_rad < kMostSigma_rad;
    const double off_rad = std::abs(view.angle_rad - view.told_rad);
    squares += off_rad * off_rad;
    report.worst_off_rad = std::max(report.worst_off_rad, off_rad);
  }
  if (!report.views.empty()) {
    report.rms_off_rad = std::sqrt(squares / static_cast<double>(report.views.size()));
  }
  if (report.sentence.empty()) {
    report.sentence = formatted(
        "By the object's own features the table stood within %.3f\u00b0 of where it was told to "
        "(rms %.3f\u00b0); this is put right.",
        degFromRad(report.worst_off_rad), degFromRad(report.rms_off_rad));
  }
  return report;
}

}  // namespace gyre
