// A length between two places on a model: its figures, and their words for people.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// A place on a model's surface, and how well the points there are known.
struct PickedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // table frame, mm
  // Of the points there, from picture noise alone: what is wrong with the calibration is common to
  // all points and not in it. [mm^2]; nothing where no camera saw the surface, or nobody told.
  std::optional<Eigen::Matrix3d> covariance;
  bool seen = true;  // false: surface that was guessed
};

// What stands behind a model's millimetres.
enum class SizeTrust : std::uint8_t {
  kUnknown,      // its calibration does not say how well the size is known
  kArbitrary,    // nothing told the scale: "millimetres" are arbitrary units
  kNotVerified,  // nobody measured the printed target: the printer is trusted
  kVerified,     // the target was measured
};

struct ModelScale {
  SizeTrust trust = SizeTrust::kUnknown;
  std::optional<double> sigma_share;  // one standard deviation of a length, over the length
};

// As the report of the calibration tells it; without one, `otherwise`. kArbitrary overrules it: the
// model was made without a scale.
ModelScale scaleOf(const CalibrationRecord& record, SizeTrust otherwise = SizeTrust::kUnknown);

struct Measurement {
  Eigen::Vector3d from_in_table = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector3d to_in_table = Eigen::Vector3d::Zero();    // mm
  double length_mm = 0.0;
  // One standard deviation of the length each: the random part of the two points along the line
  // between them, and the scale of the calibration. Nothing when unknown.
  std::optional<double> points_sigma_mm;
  std::optional<double> scale_sigma_mm;
  SizeTrust size = SizeTrust::kUnknown;
  std::optional<double> caliper_mm;  // what the user's own instrument showed
  std::string note;                  // as the user typed it
  std::string date;                  // ISO 8601

  // Both parts together, or the points' alone where the scale's is unknown. Nothing when it is
  // unknown how well the points are known.
  std::optional<double> sigmaMm() const;
};

// The length between two places. The two points count as independent of each other. Fails when the
// places are the same, or not finite.
Result<Measurement> measureLength(const PickedPoint& from, const PickedPoint& to,
                                  const ModelScale& scale);

// "83.21 ± 0.012 mm"; "83.21 mm (± unknown)"; "units" for "mm" where the scale is arbitrary.
std::string lengthText(const Measurement& measurement);

// What the ± holds and what it does not, a sentence or two.
std::string uncertaintyText(const Measurement& measurement);

// "0.031 mm (0.04 %) longer than the caliper, 0.8 times the ±."; empty without a caliper.
std::string caliperText(const Measurement& measurement);

}  // namespace gyre
