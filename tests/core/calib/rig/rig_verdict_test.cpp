// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_verdict.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

CaptureFacts goodCapture() { return {kTurn_rad, 0.7, 0.0}; }

CalibrationReport reportOf(double detail_mm, double size_mm, bool verified) {
  CalibrationReport report;
  report.local_detail_mm = detail_mm;
  report.overall_size_mm = size_mm;
  report.size_verified = verified;
  report.median_px = 0.02;
  report.views = 24;
  return report;
}

CalibrationReport judged(CalibrationReport report, const CaptureFacts& facts = goodCapture()) {
  judge({}, facts, report);
  return report;
}

TEST(RigVerdict, TellsBothFiguresOnTheObject) {
  const CalibrationReport good = judged(reportOf(0.003, 0.05, true));
  EXPECT_EQ(good.verdict, CalibrationVerdict::kGood);
  EXPECT_THAT(good.sentence, HasSubstr("object of 80 mm"));
  EXPECT_THAT(good.sentence, HasSubstr("local detail \u00b1 0.003 mm"));
  EXPECT_THAT(good.sentence, HasSubstr("overall size \u00b1 0.05 mm."));
}

TEST(RigVerdict, IsAtBestAcceptableWithoutACaliper) {
  const CalibrationReport report = judged(reportOf(0.003, 0.05, false));
  EXPECT_EQ(report.verdict, CalibrationVerdict::kAcceptable);
  EXPECT_THAT(report.sentence, HasSubstr("size not verified"));
  EXPECT_THAT(report.sentence, HasSubstr("Measure the two printed rulers"));
}

TEST(RigVerdict, SaysWhatToChangeTheCheapestFirst) {
  EXPECT_EQ(judged(reportOf(0.3, 0.05, true)).verdict, CalibrationVerdict::kRedo);
  CalibrationReport blurred = reportOf(0.1, 0.05, true);
  blurred.median_px = 0.5;
  EXPECT_THAT(judged(blurred).sentence, HasSubstr("Focus on the target"));
  EXPECT_THAT(judged(reportOf(0.1, 0.05, true), {0.5 * kTurn_rad, 0.7, 0.0}).sentence,
              HasSubstr("all the way around"));
  EXPECT_THAT(judged(reportOf(0.1, 0.05, true), {kTurn_rad, 0.2, 0.0}).sentence,
              HasSubstr("Bring the target closer"));
}

TEST(RigVerdict, NeverCallsGoodWhatIsNoNumber) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged(reportOf(nothing, 0.05, true)).verdict, CalibrationVerdict::kRedo);
  EXPECT_EQ(judged(reportOf(0.003, nothing, true)).verdict, CalibrationVerdict::kRedo);
}

TEST(RigVerdict, FallsWithWhatTheHeldOutPointsShow) {
  const CalibrationReport good = judged(reportOf(0.003, 0.05, true));
  const auto checked = [&](double detail_mm) {
    CalibrationReport report = good;
    CalibrationCheck check;
    check.points = 12;
    check.detail_mm = detail_mm;
    judgeByCheck(check, {}, report);
    return report;
  };
  const CalibrationReport held = checked(0.004);
  EXPECT_EQ(held.verdict, CalibrationVerdict::kGood);
  EXPECT_EQ(held.sentence, good.sentence);
  EXPECT_EQ(held.check_mm, 0.004);
  ASSERT_EQ(held.remarks.size(), 1U);
  EXPECT_THAT(held.remarks.front(), HasSubstr("12 points"));
  EXPECT_EQ(checked(0.1).verdict, CalibrationVerdict::kAcceptable);
  const CalibrationReport bent = checked(1.0);
  EXPECT_EQ(bent.verdict, CalibrationVerdict::kRedo);
  EXPECT_THAT(bent.sentence, HasSubstr("measured only to 1.000 mm"));
}

TEST(RigVerdict, NamesWhatMotorAndPaperDo) {
  CalibrationReport report = reportOf(0.003, 0.05, true);
  EXPECT_THAT(remarksOn(report, goodCapture()), IsEmpty());
  report.direction = -1;
  report.step_scale = 2.0;
  report.once_per_turn.amplitude_rad = radFromDeg(0.3);
  report.faces = {{0.0, 0.0, 0.0, 20}, {0.5, radFromDeg(1.0), 0.0, 20}};
  const auto remarks = remarksOn(report, {kTurn_rad, 0.7, 0.2});
  ASSERT_EQ(remarks.size(), 5U);
  EXPECT_THAT(remarks[0], HasSubstr("reversed"));
  EXPECT_THAT(remarks[1], HasSubstr("2.0000 times"));
  EXPECT_THAT(remarks[2], HasSubstr("0.30 deg"));
  EXPECT_THAT(remarks[3], HasSubstr("Face 2 of the target is bowed by 0.50 mm"));
  EXPECT_THAT(remarks[3], HasSubstr("folded 1.00 deg"));
  EXPECT_THAT(remarks[4], HasSubstr("20 %"));
}

}  // namespace
}  // namespace gyre
