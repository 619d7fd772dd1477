// What a calibration does to an open rig before a scan, on the simulated one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibrated_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

// A duck on the table; with a ring of markers under it when asked.
RigOptions duckRig(const std::string& ring = {}) {
  RigOptions options;
  options.sim.target = ring;
  options.sim_speed = 50.0;
  return options;
}

Rig opened(const RigOptions& options) {
  auto rig = openRig("sim", "sim", options, {});
  EXPECT_TRUE(rig) << rig.error().sentence();
  rig->room->setTable(TableLoad::kObject);
  return std::move(*rig);
}

TEST(CalibratedRig, TurnsTheTableAsItWasMeasured) {
  RigOptions options = duckRig();
  options.sim.firmware_steps_per_turn = 2.0 * options.sim.steps_per_turn;
  options.sim.motor_direction = -1;
  const Rig rig = opened(options);
  CalibrationRecord record = trueRecord(options.sim);
  const TurntableInfo info = rig.turntable->info();
  record.turntable = CalibratedTurntable{info.device_id, info.axis, 180.0, -1};
  const auto remarks = applyCalibration(rig, record);
  ASSERT_TRUE(remarks) << remarks.error().sentence();
  EXPECT_TRUE(remarks->empty());
  ASSERT_TRUE(rig.turntable->moveTo(0.5, {}));
  EXPECT_NEAR(trueAngleRad(options.sim, rig.room->shaft->steps()), 0.5, radFromDeg(0.3));
  // Applied again it changes nothing.
  const double angle_rad = rig.turntable->angleRad();
  ASSERT_TRUE(applyCalibration(rig, record));
  EXPECT_EQ(rig.turntable->angleRad(), angle_rad);
}

TEST(CalibratedRig, TellsThatTheTurntableIsAnother) {
  const RigOptions options = duckRig();
  const Rig rig = opened(options);
  CalibrationRecord record = trueRecord(options.sim);
  record.turntable = CalibratedTurntable{"another", "X", 180.0, -1};
  const auto remarks = applyCalibration(rig, record);
  ASSERT_TRUE(remarks);
  ASSERT_EQ(remarks->size(), 1U);
  EXPECT_THAT(remarks->front(), HasSubstr("not the one of the calibration"));
}

TEST(CalibratedRig, RefusesPicturesOfAnotherSize) {
  const RigOptions options = duckRig();
  const Rig rig = opened(options);
  CalibrationRecord record = trueRecord(options.sim);
  record.calibration.camera.width_px = 640;
  const auto remarks = prepareRig(rig, record, {}, {});
  ASSERT_FALSE(remarks);
  EXPECT_THAT(remarks.error().what, HasSubstr("1280"));
}

TEST(CalibratedRig, SeesByTheBackgroundThatTheCameraWasMoved) {
  const TempDir temp;
  RigOptions options = duckRig();
  {
    const Rig rig = opened(options);
    const auto before = rig.camera->grabAfter(steadySeconds(), {});
    ASSERT_TRUE(before);
    ASSERT_TRUE(writePicture(temp / "calibration.png", (*before)->image_bgr));
    const auto still = lookBeforeScan(rig, trueRecord(options.sim), temp / "calibration.png", {});
    ASSERT_TRUE(still);
    EXPECT_EQ(*still, "");
  }
  options.sim.bump_px = 3.0;
  options.sim.bump_at_deg = 0.0;
  const auto moved =
      lookBeforeScan(opened(options), trueRecord(options.sim), temp / "calibration.png", {});
  ASSERT_TRUE(moved);
  EXPECT_THAT(*moved, HasSubstr("The camera has moved"));
  // Without the picture nothing can be said.
  EXPECT_EQ(*lookBeforeScan(opened(options), trueRecord(options.sim), temp / "gone.png", {}), "");
}

TEST(CalibratedRig, SeesByTheRingThatCameraOrTableWereMoved) {
  RigOptions options = duckRig("ring");
  const Rig rig = opened(options);
  ASSERT_TRUE(rig.turntable->moveTo(1.0, {}));  // at whatever angle
  const auto still = lookBeforeScan(rig, trueRecord(options.sim), {}, {});
  ASSERT_TRUE(still) << still.error().sentence();
  EXPECT_EQ(*still, "");

  // The table was pushed: the camera sees the platter elsewhere than it was.
  CalibrationRecord pushed = trueRecord(options.sim);
  pushed.calibration.cam_from_table->translation.x() += 0.5;
  const auto moved = lookBeforeScan(rig, pushed, {}, {});
  ASSERT_TRUE(moved);
  EXPECT_THAT(*moved, HasSubstr("were moved"));
}

}  // namespace
}  // namespace gyre
