// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/calibration_record_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include <Eigen/Geometry>

#include "core/io/calibration_file.h"
#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

CalibrationRecord fullRecord() {
  CalibrationRecord record;
  CameraModel& camera = record.calibration.camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx = 2400.0 + 1.0 / 3.0;
  camera.fy = 2400.1;
  camera.cx = 647.5;
  camera.cy = 473.5;
  record.calibration.cam_from_table =
      Rigid3{Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix(),
             {1.0 / 7.0, -20.0, 350.0}};
  record.date = "2030-02-03T04:05:06Z";
  record.target = "wedge \"A4\" ö";
  record.table_from_target =
      Rigid3{Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0.1, 0.2, 0.3}};
  record.points_in_target = {{1.0 / 3.0, 2.0, 3.0}, {-4.0, 0.1 + 0.2, 0.0}};
  record.turntable = CalibratedTurntable{"usb-Arduino_1", "X", 360.0 / 7.0, -1, 0.1 / 3.0, 0.35};
  record.camera = CalibratedCamera{"/dev/v4l/by-id/cam", "1920x1080@MJPG", {{"focus", 0.1 + 0.2}}};
  record.covariance = NamedCovariance{{"focal_px", "k1"}, Eigen::MatrixXd::Random(2, 2) / 3.0};
  CalibrationReport report;
  report.verdict = CalibrationVerdict::kAcceptable;
  report.sentence = "Acceptable: size not verified.";
  report.remarks = {"one", "two \\ three"};
  report.local_detail_mm = 0.1 / 3.0;
  report.size_verified = true;
  report.check_mm = 0.004;
  report.views = 24;
  report.sightings = 4321;
  report.direction = -1;
  report.step_scale = 2.0000000000000004;
  report.once_per_turn = {0.1 / 7.0, -2.0};
  report.angles_rad = {0.0, 1.0 / 3.0, -5e-324};
  report.faces = {{0.5 / 3.0, 0.01, 0.2, 36}};
  report.residuals = {{3, 17, {1.5, 2.25}, {0.1 / 3.0, -0.05}, false}};
  record.report = report;
  return record;
}

TEST(CalibrationRecord, KeepsEveryBit) {
  const TempDir dir;
  const CalibrationRecord record = fullRecord();
  ASSERT_TRUE(writeCalibrationRecord(dir / "calibration.json", record));
  const auto back = readCalibrationRecord(dir / "calibration.json");
  ASSERT_TRUE(back) << back.error().sentence();
  // All fields are in the text, and numbers are written so that they are read again exactly.
  EXPECT_EQ(calibrationRecordText(*back), calibrationRecordText(record));
  EXPECT_EQ(back->date, record.date);
  EXPECT_EQ(back->target, record.target);
  EXPECT_EQ(back->turntable, record.turntable);
  EXPECT_EQ(back->camera, record.camera);
  EXPECT_EQ(back->table_from_target->rotation, record.table_from_target->rotation);
  EXPECT_EQ(back->points_in_target, record.points_in_target);
  EXPECT_EQ(back->covariance->matrix, record.covariance->matrix);
  EXPECT_EQ(back->covariance->names, record.covariance->names);
  const CalibrationReport& report = *back->report;
  EXPECT_EQ(report.verdict, CalibrationVerdict::kAcceptable);
  EXPECT_EQ(report.remarks, record.report->remarks);
  EXPECT_EQ(report.step_scale, record.report->step_scale);
  EXPECT_EQ(report.direction, -1);
  EXPECT_EQ(report.angles_rad, record.report->angles_rad);
  EXPECT_EQ(report.faces.at(0).bow_mm, record.report->faces[0].bow_mm);
  EXPECT_EQ(report.faces.at(0).points, 36U);
  EXPECT_EQ(report.residuals.at(0).residual_px, record.report->residuals[0].residual_px);
  EXPECT_FALSE(report.residuals.at(0).used);
}

TEST(CalibrationRecord, IsACalibrationToThoseWhoWantNoMore) {
  const CalibrationRecord record = fullRecord();
  const auto calibration = parseCalibration(calibrationRecordText(record), "f");
  ASSERT_TRUE(calibration) << calibration.error().sentence();
  EXPECT_EQ(calibration->camera.fx, record.calibration.camera.fx);
  EXPECT_EQ(calibration->cam_from_table->rotation, record.calibration.cam_from_table->rotation);
}

TEST(CalibrationRecord, ReadsFilesThatHoldNothingElse) {
  CalibrationRecord record = fullRecord();
  record.calibration.cam_from_table.reset();
  const auto back = parseCalibrationRecord(calibrationText(record.calibration), "f");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_FALSE(back->report || back->covariance || back->turntable || back->camera);
  EXPECT_FALSE(back->calibration.cam_from_table);
}

TEST(CalibrationRecord, PassesOverWhatOthersWriteUnderTheSameNames) {
  std::string text = calibrationText(fullRecord().calibration);
  text.insert(text.rfind("\n}"),
              R"(, "report": 3, "residuals": [1, 2], "covariance": {"names": ["a"], "matrix": []},
              "turntable": null, "capture": [], "table_from_target": {"rotation": 1}, "date": 5)");
  const auto back = parseCalibrationRecord(text, "f");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_FALSE(back->report || back->covariance || back->turntable || back->camera);
  EXPECT_FALSE(back->table_from_target);
}

TEST(CalibrationRecord, SurvivesDamage) {
  const std::string text = calibrationRecordText(fullRecord());
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const auto record = parseCalibrationRecord(mutated(text, seed), "f");
    if (!record) {
      EXPECT_FALSE(record.error().what.empty());
    }
  }
}

TEST(CalibrationRecord, LeavesOutResidualsThatAreNoNumbersAndRefusesOtherSuch) {
  const TempDir dir;
  CalibrationRecord record = fullRecord();
  record.report->residuals[0].residual_px.x() = std::numeric_limits<double>::infinity();
  ASSERT_TRUE(writeCalibrationRecord(dir / "c.json", record));
  EXPECT_TRUE(readCalibrationRecord(dir / "c.json")->report->residuals.empty());
  record.report->rms_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(writeCalibrationRecord(dir / "c.json", record));
}

}  // namespace
}  // namespace gyre
