// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/fit_report.h"

#include <algorithm>
#include <cmath>

namespace gyre {

void summarizeResiduals(CalibrationReport& report) {
  std::vector<double> lengths_px;
  double squares_px = 0.0;
  for (const CalibrationResidual& residual : report.residuals) {
    if (!residual.used) continue;
    lengths_px.push_back(residual.residual_px.norm());
    squares_px += residual.residual_px.squaredNorm();
  }
  report.sightings = lengths_px.size();
  report.outliers = report.residuals.size() - lengths_px.size();
  if (lengths_px.empty()) return;
  report.rms_px = std::sqrt(squares_px / static_cast<double>(lengths_px.size()));
  const auto middle = lengths_px.begin() + static_cast<std::ptrdiff_t>(lengths_px.size() / 2);
  std::nth_element(lengths_px.begin(), middle, lengths_px.end());
  report.median_px = *middle;
  report.worst_px = *std::max_element(lengths_px.begin(), lengths_px.end());
}

void reportSigmas(const CameraCovariance& covariance, CalibrationReport& report) {
  report.focal_sigma_px = std::sqrt(std::max(covariance(kFx, kFx), covariance(kFy, kFy)));
  report.principal_sigma_px = std::sqrt(std::max(covariance(kCx, kCx), covariance(kCy, kCy)));
}

}  // namespace gyre
