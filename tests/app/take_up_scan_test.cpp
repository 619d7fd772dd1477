// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/take_up_scan.h"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/sim/rig.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kViews = 24;
constexpr int kCaptured = 6;

RigOptions options() {
  RigOptions options;
  options.sim = atImageWidth(RigSettings{}, 640);
  options.sim_speed = 50.0;
  return options;
}

// A scan of which six views were taken when its program died; the rig is another program's.
class TakeUpScan : public testing::Test {
 protected:
  TakeUpScan() {
    ScanSettings settings;
    settings.views = kViews;
    settings.camera_controls = {{"focus", true, 0.0, ""}};
    store_.emplace(
        ScanStore::create(folder_.path() / "scan", settings, trueCalibration(options().sim))
            .value());
    const Renderer renderer(options().sim);
    for (int view = 0; view < kCaptured; ++view) {
      const std::int64_t steps = options().sim.steps_per_turn * view / kViews;
      Frame frame = renderer.render(steps, TableLoad::kObject);
      frame.view = view;
      frame.table_angle_rad = kTurn_rad * view / kViews;
      EXPECT_TRUE(store_->addView(frame, steps));
    }
  }

  // The rig with its table turned to an angle, which its board does not know any more.
  static Rig rigAt(double angle_deg, const RigSettings& sim) {
    RigOptions changed = options();
    changed.sim = sim;
    Rig rig = openRig("sim", "sim", changed, {}).value();
    rig.room->setTable(TableLoad::kObject);
    EXPECT_TRUE(rig.turntable->moveTo(radFromDeg(angle_deg), {}));
    EXPECT_TRUE(rig.turntable->setAngle(2.0));
    return rig;
  }
  static Rig rigAt(double angle_deg) { return rigAt(angle_deg, options().sim); }

  TempDir folder_;
  std::optional<ScanStore> store_;
};

TEST_F(TakeUpScan, GoesOnWhereAViewIsSeenAndMovesNothing) {
  Rig rig = rigAt(45.0);
  const auto steps = rig.room->shaft->steps();
  const auto remarks = takeUpScan(rig, *store_, TakeUp::kProve, {});
  ASSERT_TRUE(remarks) << remarks.error().sentence();
  EXPECT_THAT(*remarks, IsEmpty());
  EXPECT_NEAR(degFromRad(rig.turntable->angleRad()), 45.0, 0.12);
  EXPECT_EQ(rig.room->shaft->steps(), steps);
}

// A board that was told to move goes on when the program is killed: it stands at the next view.
TEST_F(TakeUpScan, FindsTheAngleOfATableThatWentOnAndProvesItAtTheLastView) {
  Rig rig = rigAt(90.0);
  const auto remarks = takeUpScan(rig, *store_, TakeUp::kProve, {});
  ASSERT_TRUE(remarks) << remarks.error().sentence();
  EXPECT_THAT(*remarks, IsEmpty());
  EXPECT_NEAR(degFromRad(rig.turntable->angleRad()), 75.0, 0.12);
  const double true_deg =
      360.0 * static_cast<double>(rig.room->shaft->steps()) / options().sim.steps_per_turn;
  EXPECT_NEAR(true_deg, 75.0, 0.5);
}

TEST_F(TakeUpScan, RefusesAnotherObjectUnlessSomebodyTrustsIt) {
  RigSettings other = options().sim;
  other.object = "mouse";
  Rig rig = rigAt(30.0, other);
  const auto refused = takeUpScan(rig, *store_, TakeUp::kProve, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Error::Code::kRejected);
  EXPECT_FALSE(refused.error().advice.empty());
  const auto trusted = takeUpScan(rig, *store_, TakeUp::kTrust, {});
  ASSERT_TRUE(trusted) << trusted.error().sentence();
  EXPECT_EQ(trusted->size(), 1U);
}

TEST_F(TakeUpScan, MovesNothingWhereNothingIsRecognised) {
  RigSettings elsewhere = options().sim;
  elsewhere.object = "mouse";
  elsewhere.seed = 77;  // another platter, another room
  Rig rig = rigAt(30.0, elsewhere);
  const auto steps = rig.room->shaft->steps();
  const auto refused = takeUpScan(rig, *store_, TakeUp::kProve, {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("sees none of the views"));
  EXPECT_EQ(rig.room->shaft->steps(), steps);
}

TEST_F(TakeUpScan, RefusesAPushedObject) {
  RigSettings pushed = options().sim;
  pushed.object_offset_mm += 2.0;
  Rig rig = rigAt(75.0, pushed);
  const auto refused = takeUpScan(rig, *store_, TakeUp::kProve, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Error::Code::kRejected) << refused.error().sentence();
}

TEST_F(TakeUpScan, BeginsAtTheStartWhereNothingIsCaptured) {
  const TempDir dir;
  ScanSettings settings;
  settings.views = kViews;
  const auto store =
      ScanStore::create(dir / "scan", settings, trueCalibration(options().sim)).value();
  Rig rig = rigAt(20.0);
  ASSERT_TRUE(takeUpScan(rig, store, TakeUp::kProve, {}));
  EXPECT_EQ(rig.turntable->angleRad(), 0.0);
}

}  // namespace
}  // namespace gyre
