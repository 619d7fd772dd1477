// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/measurement.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

PickedPoint pickedAt(const Eigen::Vector3d& position, const Eigen::Vector3d& sigmas_mm) {
  PickedPoint point;
  point.position = position;
  point.covariance = Eigen::Matrix3d(sigmas_mm.cwiseAbs2().asDiagonal());
  return point;
}

TEST(MeasureLength, CountsOnlyWhatLiesAlongTheLine) {
  const PickedPoint from = pickedAt({0, 0, 0}, {0.03, 9.0, 9.0});
  const PickedPoint to = pickedAt({50, 0, 0}, {0.04, 9.0, 9.0});
  const auto measured = measureLength(from, to, {});
  ASSERT_TRUE(measured);
  EXPECT_DOUBLE_EQ(measured->length_mm, 50.0);
  EXPECT_NEAR(*measured->sigmaMm(), 0.05, 1e-12);
}

TEST(MeasureLength, SpreadsAsLengthsOfNoisyEndsDo) {
  const Eigen::Vector3d sigmas_mm(0.05, 0.1, 0.2);
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d b(21, -8, 33);
  const auto measured = measureLength(pickedAt(a, sigmas_mm), pickedAt(b, sigmas_mm), {});
  ASSERT_TRUE(measured);
  Random random(4);
  constexpr int kTrials = 20000;
  double squares_mm2 = 0.0;
  const auto noise = [&]() -> Eigen::Vector3d {
    return Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian())
        .cwiseProduct(sigmas_mm);
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    const double off_mm = (b + noise() - a - noise()).norm() - (b - a).norm();
    squares_mm2 += off_mm * off_mm;
  }
  // The sample deviation of 20 000 trials errs by 0.5 %; four times that.
  EXPECT_NEAR(*measured->sigmaMm() / std::sqrt(squares_mm2 / kTrials), 1.0, 0.02);
}

TEST(MeasureLength, AddsTheScaleOfTheCalibration) {
  CalibrationRecord record;
  record.report.emplace();
  record.report->object_size_mm = 80.0;
  record.report->overall_size_mm = 0.08;
  const ModelScale scale = scaleOf(record);
  EXPECT_EQ(scale.trust, SizeTrust::kNotVerified);
  const auto measured = measureLength(pickedAt({0, 0, 0}, {0.03, 0.03, 0.03}),
                                      pickedAt({0, 40, 0}, {0, 0, 0}), scale);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(*measured->scale_sigma_mm, 0.04, 1e-12);
  EXPECT_NEAR(*measured->sigmaMm(), 0.05, 1e-12);
  EXPECT_THAT(uncertaintyText(*measured), HasSubstr("Size not verified"));
  record.report->size_verified = true;
  EXPECT_EQ(scaleOf(record).trust, SizeTrust::kVerified);
}

TEST(MeasureLength, SaysWhatIsUnknown) {
  PickedPoint guessed;
  guessed.position = {10, 0, 0};
  guessed.seen = false;
  const auto measured = measureLength(pickedAt({0, 0, 0}, {0.1, 0.1, 0.1}), guessed, {});
  ASSERT_TRUE(measured);
  EXPECT_FALSE(measured->sigmaMm());
  EXPECT_EQ(lengthText(*measured), "10.00 mm (± unknown)");
  EXPECT_THAT(uncertaintyText(*measured), HasSubstr("no camera saw"));
  EXPECT_THAT(uncertaintyText(*measured), HasSubstr("its calibration does not say"));
}

TEST(MeasureLength, RefusesWhatIsNoLength) {
  const PickedPoint one = pickedAt({1, 2, 3}, {0, 0, 0});
  EXPECT_THAT(measureLength(one, one, {}).error().what, HasSubstr("the same"));
  PickedPoint none = one;
  none.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(measureLength(one, none, {}));
}

TEST(ScaleOf, IsUnknownWithoutAReportAndArbitraryWithoutAScale) {
  CalibrationRecord record;
  EXPECT_EQ(scaleOf(record).trust, SizeTrust::kUnknown);
  EXPECT_EQ(scaleOf(record, SizeTrust::kVerified).trust, SizeTrust::kVerified);
  record.report.emplace();
  record.report->overall_size_mm = 0.1;
  EXPECT_EQ(scaleOf(record, SizeTrust::kArbitrary).trust, SizeTrust::kArbitrary);
  EXPECT_FALSE(scaleOf(record, SizeTrust::kArbitrary).sigma_share);
  record.report->overall_size_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(scaleOf(record).sigma_share);
}

TEST(MeasurementWords, TellTwoDigitsOfTheUncertainty) {
  Measurement one;
  one.length_mm = 83.21449;
  one.points_sigma_mm = 0.0123;
  EXPECT_EQ(lengthText(one), "83.214 ± 0.012 mm");
  one.points_sigma_mm = 1.26;
  EXPECT_EQ(lengthText(one), "83.2 ± 1.3 mm");
  one.points_sigma_mm = 0.0;
  EXPECT_EQ(lengthText(one), "83.214 ± 0.000 mm");
}

TEST(MeasurementWords, HoldTheLengthAgainstTheCaliper) {
  Measurement one;
  one.length_mm = 50.1;
  one.points_sigma_mm = 0.05;
  EXPECT_EQ(caliperText(one), "");
  one.caliper_mm = 50.0;
  EXPECT_EQ(caliperText(one), "0.100 mm (0.20 %) longer than the caliper, 2.0 times the ±.");
  one.caliper_mm = 50.2;
  one.points_sigma_mm.reset();
  EXPECT_EQ(caliperText(one), "0.100 mm (0.20 %) shorter than the caliper.");
}

TEST(MeasurementWords, CallNoMillimetreWhatIsNone) {
  Measurement one;
  one.length_mm = 50.0;
  one.points_sigma_mm = 0.05;
  one.size = SizeTrust::kArbitrary;
  one.caliper_mm = 25.0;
  EXPECT_EQ(lengthText(one), "50.000 ± 0.050 units");
  EXPECT_THAT(uncertaintyText(one), HasSubstr("arbitrary units"));
  EXPECT_EQ(caliperText(one), "The caliper says 25 mm: one unit is 0.5 mm.");
  EXPECT_THAT(caliperText(one), Not(HasSubstr("longer")));
}

}  // namespace
}  // namespace gyre
