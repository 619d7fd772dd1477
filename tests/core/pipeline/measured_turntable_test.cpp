// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/measured_turntable.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/watched_target.h"

namespace gyre {
namespace {

CalibrationRecord recordOfAnOddTable() {
  CalibrationRecord record;
  record.turntable = CalibratedTurntable{"an odd table", "X", 360.0, 1, radFromDeg(3.0), 0.4};
  return record;
}

TEST(MeasuredTurntable, IsTheOneOfTheRecordWhenDeviceAndAxisAreTheSame) {
  const test::OddTable table([](double told_rad) { return told_rad; });
  const CalibratedTurntable known = measuredTurntable(table.info(), recordOfAnOddTable());
  EXPECT_EQ(known.backlash_rad, radFromDeg(3.0));
  EXPECT_EQ(known.settle_s, 0.4);
}

TEST(MeasuredTurntable, KnowsNothingOfAnotherDeviceAnotherAxisOrWithoutARecord) {
  TurntableInfo info = test::OddTable([](double told_rad) { return told_rad; }).info();
  EXPECT_EQ(measuredTurntable(info, CalibrationRecord()), CalibratedTurntable());
  info.axis = "A";
  EXPECT_EQ(measuredTurntable(info, recordOfAnOddTable()).backlash_rad, 0.0);
  info.axis = "X";
  info.device_id = "another table";
  EXPECT_EQ(measuredTurntable(info, recordOfAnOddTable()).settle_s, 0.0);
}

TEST(TakeUpBacklash, PassesPlacesByMoreThanThePlayAndKeepsALongerWay) {
  test::OddTable table([](double told_rad) { return told_rad; });
  table.setApproach(radFromDeg(2.0));
  for (const double nothing_rad : {0.0, -1.0, std::nan("")}) {
    takeUpBacklash(table, nothing_rad);
    EXPECT_EQ(table.approachRad(), radFromDeg(2.0));
  }
  takeUpBacklash(table, radFromDeg(1.0));
  EXPECT_EQ(table.approachRad(), radFromDeg(2.0));
  takeUpBacklash(table, radFromDeg(3.0));
  EXPECT_GT(table.approachRad(), radFromDeg(3.0));
  EXPECT_LT(table.approachRad(), radFromDeg(4.0));
}

}  // namespace
}  // namespace gyre
