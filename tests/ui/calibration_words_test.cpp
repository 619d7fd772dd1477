// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_words.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

QDateTime noon(int day) { return {QDate(2031, 5, day), QTime(12, 0)}; }

CalibrationRecord measuredOn(int day) {
  CalibrationRecord record;
  record.date = noon(day).toUTC().toString(Qt::ISODate).toStdString();
  return record;
}

TEST(CalibrationWords, TellTheAgeInDays) {
  EXPECT_EQ(ageText(measuredOn(10), noon(10)), "measured today");
  EXPECT_EQ(ageText(measuredOn(10), noon(11)), "measured yesterday");
  EXPECT_EQ(ageText(measuredOn(10), noon(24)), "measured 14 days ago");
  EXPECT_EQ(ageText(measuredOn(10), noon(9)), QString());  // a clock that went wrong
  EXPECT_EQ(ageText({}, noon(9)), QString());
}

TEST(CalibrationWords, TellBothFiguresAndWhetherTheSizeIsSure) {
  CalibrationReport report;
  report.verdict = CalibrationVerdict::kAcceptable;
  report.local_detail_mm = 0.0041;
  report.overall_size_mm = 0.2;
  EXPECT_EQ(qualityText(report),
            QString("△ Acceptable: detail ± 0.004 mm, size ± 0.20 mm (size not verified)"));
  report.verdict = CalibrationVerdict::kGood;
  report.size_verified = true;
  EXPECT_EQ(qualityText(report), QString("✓ Good: detail ± 0.004 mm, size ± 0.20 mm"));
}

TEST(CalibrationWords, LeaveOutWhatIsNotKnown) {
  EXPECT_EQ(calibrationText({}, noon(1)), QString());
  CalibrationRecord record = measuredOn(10);
  record.report.emplace();  // a fit without a verdict
  EXPECT_EQ(calibrationText(record, noon(11)), "measured yesterday");
  record.report->sentence = "Redo.";
  EXPECT_EQ(calibrationText(record, noon(11)),
            QString("✗ Do it again: detail ± 0.000 mm, size ± 0.00 mm (size not verified) · "
                    "measured yesterday"));
}

}  // namespace
}  // namespace gyre
