// The picture of the bare table on its way into a scan, on the simulated rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/empty_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/scan_session.h"
#include "core/base/units.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RigOptions smallRig() {
  RigOptions options;
  options.sim = atImageWidth(RigSettings{}, 320);
  options.sim_speed = 50.0;
  return options;
}

Rig opened(const RigOptions& options) {
  auto rig = openRig("sim", "sim", options, {});
  EXPECT_TRUE(rig) << rig.error().sentence();
  return std::move(*rig);
}

double standsAtRad(const Rig& rig) {
  return trueAngleRad(rig.room->settings, rig.room->shaft->steps());
}

ScanPlan planInto(const std::filesystem::path& folder, const Rig& rig) {
  ScanPlan plan;
  plan.folder = folder;
  plan.settings.views = 4;
  plan.calibration.calibration = trueCalibration(rig.room->settings);
  return plan;
}

double keptAngleRad(const std::filesystem::path& folder) {
  const auto store = ScanStore::open(folder);
  EXPECT_TRUE(store) << store.error().sentence();
  const auto kept = store->readEmptyTable();
  EXPECT_TRUE(kept) << kept.error().sentence();
  return kept ? (*kept)->table_angle_rad : 99.0;
}

// Between the picture and the scan the table is turned by hand on the Connect page, and the scan's
// calibration tells that the board counts double and the other way.
TEST(EmptyTable, KeepsItsAngleHoweverTheTableIsTurnedAndCorrected) {
  const TempDir dir;
  RigOptions options = smallRig();
  options.sim.firmware_steps_per_turn = 2.0 * options.sim.steps_per_turn;
  options.sim.motor_direction = -1;
  Rig rig = opened(options);
  ASSERT_TRUE(rig.turntable->moveTo(0.25, {}));
  const auto picture = pictureOfEmptyTable(rig, {});
  ASSERT_TRUE(picture) << picture.error().sentence();
  const double pictured_rad = standsAtRad(rig);
  ASSERT_TRUE(rig.turntable->moveTo(-0.1, {}));

  ScanPlan plan = planInto(dir / "duck", rig);
  plan.empty_table = *picture;
  const TurntableInfo info = rig.turntable->info();
  plan.calibration.turntable = CalibratedTurntable{info.device_id, info.axis, 180.0, -1};
  const double begun_rad = standsAtRad(rig);
  const auto scanned = runScanSession(rig, plan, {}, {});
  ASSERT_TRUE(scanned) << scanned.error().sentence();
  EXPECT_GT(std::abs(pictured_rad - begun_rad), 0.5);
  EXPECT_NEAR(keptAngleRad(dir / "duck"), pictured_rad - begun_rad, radFromDeg(0.3));
}

TEST(EmptyTable, ServesASecondScanAfterACorrection) {
  const TempDir dir;
  RigOptions options = smallRig();
  options.sim.firmware_steps_per_turn = 2.0 * options.sim.steps_per_turn;
  Rig rig = opened(options);
  ASSERT_TRUE(rig.turntable->moveTo(0.4, {}));
  const auto picture = pictureOfEmptyTable(rig, {});
  ASSERT_TRUE(picture);
  const double pictured_rad = standsAtRad(rig);
  ASSERT_TRUE(rig.turntable->correct(2.0));  // a calibration in between
  const double corrected_rad = standsAtRad(rig);
  ASSERT_TRUE(rig.turntable->moveTo(1.0, {}));
  ScanPlan plan = planInto(dir / "duck", rig);
  plan.empty_table = *picture;
  ASSERT_TRUE(runScanSession(rig, plan, {}, {}));
  // The scan's angles are counted from where the table was corrected.
  EXPECT_NEAR(keptAngleRad(dir / "duck"), pictured_rad - corrected_rad, radFromDeg(0.3));
}

TEST(EmptyTable, IsLeftOutWhenTheTablesPlaceWasLost) {
  const TempDir dir;
  Rig rig = opened(smallRig());
  const auto picture = pictureOfEmptyTable(rig, {});
  ASSERT_TRUE(picture);
  ASSERT_TRUE(rig.turntable->release());  // turned by hand
  ASSERT_TRUE(rig.turntable->setAngle(0.0));
  auto store = ScanStore::create(dir / "duck", {}, trueCalibration(rig.room->settings));
  ASSERT_TRUE(store) << store.error().sentence();
  const auto kept = keepEmptyTable(*picture, *rig.turntable, *store);
  ASSERT_TRUE(kept) << kept.error().sentence();
  EXPECT_FALSE(*kept);
  EXPECT_FALSE(store->readEmptyTable());
}

TEST(EmptyTable, TellsThatItIsTakenAgain) {
  const TempDir dir;
  Rig rig = opened(smallRig());
  ScanPlan plan = planInto(dir / "duck", rig);
  plan.empty_table = pictureOfEmptyTable(rig, {}).value();
  ASSERT_TRUE(rig.turntable->release());
  ASSERT_TRUE(rig.turntable->setAngle(0.0));
  std::vector<std::string> remarks;
  ScanObserver observer;
  observer.on_remark = [&](const std::string& remark) { remarks.push_back(remark); };
  ASSERT_TRUE(runScanSession(rig, plan, observer, {}));
  EXPECT_THAT(remarks, ElementsAre(HasSubstr("not known any more: it is taken again.")));
}

TEST(EmptyTable, FromAFileMustHaveTheCalibrationsSize) {
  const TempDir dir;
  const Rig rig = opened(smallRig());
  auto store = ScanStore::create(dir / "duck", {}, trueCalibration(rig.room->settings));
  ASSERT_TRUE(store);
  const cv::Mat other(20, 30, CV_8UC3, cv::Scalar::all(90));
  ASSERT_TRUE(writePicture(dir / "other.png", other));
  const auto kept = keepEmptyTable(dir / "other.png", *store);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().what, HasSubstr("The picture of the empty table has 30 x 20 pixels"));
  EXPECT_FALSE(keepEmptyTable(dir / "nowhere.png", *store));
}

}  // namespace
}  // namespace gyre
