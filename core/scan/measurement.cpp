// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/measurement.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr double kSame_mm = 1e-9;

// Digits after the point by which the last two of the uncertainty are told.
int decimalsFor(double sigma_mm) {
  if (!(sigma_mm > 0.0)) return 3;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma_mm))), 0, 4);
}

const char* unitOf(const Measurement& measurement) {
  return measurement.size == SizeTrust::kArbitrary ? "units" : "mm";
}

std::string numberText(double number, int decimals) { return formatted("%.*f", decimals, number); }

}  // namespace

ModelScale scaleOf(const CalibrationRecord& record, SizeTrust otherwise) {
  if (otherwise == SizeTrust::kArbitrary || !record.report) return {otherwise, std::nullopt};
  const CalibrationReport& report = *record.report;
  ModelScale scale;
  scale.trust = report.size_verified ? SizeTrust::kVerified : SizeTrust::kNotVerified;
  const double share = report.overall_size_mm / report.object_size_mm;
  if (std::isfinite(share) && share > 0.0) scale.sigma_share = share;
  return scale;
}

std::optional<double> Measurement::sigmaMm() const {
  if (!points_sigma_mm) return std::nullopt;
  return std::hypot(*points_sigma_mm, scale_sigma_mm.value_or(0.0));
}

Result<Measurement> measureLength(const PickedPoint& from, const PickedPoint& to,
                                  const ModelScale& scale) {
  const Eigen::Vector3d between = to.position - from.position;
  const double length_mm = between.norm();
  if (!std::isfinite(length_mm)) {
    return Error{Error::Code::kInvalidInput, "A place to measure from is not a finite number.",
                 "Give three coordinates in mm for each place."};
  }
  if (length_mm < kSame_mm) {
    return Error{Error::Code::kInvalidInput, "Both places to measure between are the same.",
                 "Choose two different places."};
  }
  Measurement measurement;
  measurement.from_in_table = from.position;
  measurement.to_in_table = to.position;
  measurement.length_mm = length_mm;
  measurement.size = scale.trust;
  // First order: moving an end by e changes the length by e's share along the line.
  const Eigen::Vector3d along = between / length_mm;
  if (from.covariance && to.covariance) {
    const double variance_mm2 = along.dot((*from.covariance + *to.covariance) * along);
    measurement.points_sigma_mm = std::sqrt(std::max(0.0, variance_mm2));
  }
  if (scale.sigma_share) measurement.scale_sigma_mm = length_mm * *scale.sigma_share;
  return measurement;
}

std::string lengthText(const Measurement& measurement) {
  const char* unit = unitOf(measurement);
  const auto sigma_mm = measurement.sigmaMm();
  if (!sigma_mm) return numberText(measurement.length_mm, 2) + " " + unit + " (± unknown)";
  const int decimals = decimalsFor(*sigma_mm);
  return numberText(measurement.length_mm, decimals) + " ± " + numberText(*sigma_mm, decimals) +
         " " + unit;
}

std::string uncertaintyText(const Measurement& measurement) {
  std::string text;
  if (!measurement.points_sigma_mm) {
    text =
        "How well the two places are known is unknown: no camera saw one of them, or the model "
        "does not tell.";
  } else {
    const double points_mm = *measurement.points_sigma_mm;
    text = "The ± is one standard deviation of the two points (± " +
           numberText(points_mm, decimalsFor(points_mm)) + " " + unitOf(measurement) + ")";
    if (const auto& scale_mm = measurement.scale_sigma_mm) {
      text += " and of the calibration's size (± " + numberText(*scale_mm, decimalsFor(*scale_mm)) +
              " mm).";
    } else {
      text += " alone.";
    }
  }
  switch (measurement.size) {
    case SizeTrust::kArbitrary:
      return text + " Nothing told the model's scale: these are arbitrary units.";
    case SizeTrust::kNotVerified:
      return text + " Size not verified: nobody measured the printed target.";
    case SizeTrust::kUnknown:
      return text + " How true the size is, its calibration does not say.";
    case SizeTrust::kVerified:
      break;
  }
  return text;
}

std::string caliperText(const Measurement& measurement) {
  if (!measurement.caliper_mm) return {};
  const double off_mm = measurement.length_mm - *measurement.caliper_mm;
  const auto sigma_mm = measurement.sigmaMm();
  if (measurement.size == SizeTrust::kArbitrary) {
    return formatted("The caliper says %.10g mm: one unit is %.6g mm.", *measurement.caliper_mm,
                     *measurement.caliper_mm / measurement.length_mm);
  }
  std::string text = formatted("%.3f mm (%.2f %%) %s than the caliper", std::abs(off_mm),
                               100.0 * std::abs(off_mm) / *measurement.caliper_mm,
                               off_mm < 0.0 ? "shorter" : "longer");
  if (sigma_mm && *sigma_mm > 0.0) {
    text += formatted(", %.1f times the ±", std::abs(off_mm) / *sigma_mm);
  }
  return text + ".";
}

}  // namespace gyre
