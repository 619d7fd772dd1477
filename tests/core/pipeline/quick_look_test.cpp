// A few pictures around an object tell whether it will scan well, and why not.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/quick_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <string>

#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/device/streaming_camera.h"
#include "core/sim/renderer.h"
#include "core/sim/sim_camera.h"
#include "core/sim/turntable_firmware.h"

namespace gyre {
namespace {

using testing::HasSubstr;

RigSettings smallRig() {
  RigSettings rig = atImageWidth({}, 640);
  rig.image_height_px = 480;
  return rig;
}

struct Seen {
  FramePtr empty;
  std::vector<FramePtr> pictures;
};

Seen lookAround(const RigSettings& rig) {
  const Renderer renderer(rig);
  Seen seen;
  seen.empty = std::make_shared<const Frame>(renderer.render(0, TableLoad::kEmpty));
  for (int view = 0; view < kQuickViews; ++view) {
    Frame frame = renderer.render(rig.steps_per_turn * view / kQuickViews, TableLoad::kObject);
    frame.table_angle_rad = kTurn_rad * view / kQuickViews;
    seen.pictures.push_back(std::make_shared<const Frame>(std::move(frame)));
  }
  return seen;
}

QuickLook judged(const RigSettings& rig) {
  const Seen seen = lookAround(rig);
  auto look = judgeQuickLook(trueCalibration(rig), seen.empty, seen.pictures, {});
  EXPECT_TRUE(look.ok());
  return look ? std::move(look).value() : QuickLook{};
}

const QuickFinding& finding(const QuickLook& look, QuickAspect aspect) {
  return look.findings[static_cast<std::size_t>(aspect)];
}

void expectGoodBut(const QuickLook& look, QuickAspect aspect) {
  for (const QuickFinding& each : look.findings) {
    if (each.aspect != aspect) {
      EXPECT_EQ(each.verdict, QuickVerdict::kGood) << each.sentence;
    }
  }
}

TEST(QuickLook, FindsNothingWrongWithTheDuckAndTheCube) {
  for (const char* object : {"duck", "cube"}) {
    RigSettings rig = smallRig();
    rig.object = object;
    const QuickLook look = judged(rig);
    EXPECT_EQ(look.verdict, QuickVerdict::kGood);
    for (const QuickFinding& each : look.findings) {
      EXPECT_EQ(each.verdict, QuickVerdict::kGood) << each.sentence;
      EXPECT_FALSE(each.sentence.empty());
      EXPECT_EQ(each.advice, "");
    }
    ASSERT_EQ(look.views.size(), static_cast<std::size_t>(kQuickViews));
    for (const QuickView& view : look.views) EXPECT_EQ(view.fault, "");
  }
}

TEST(QuickLook, TellsABlurredObjectPlainOrNot) {
  for (const char* object : {"duck", "plain"}) {
    RigSettings rig = smallRig();
    rig.object = object;
    rig.blur_sigma_px = 4.0;
    const QuickFinding sharp = finding(judged(rig), QuickAspect::kSharp);
    EXPECT_EQ(sharp.verdict, QuickVerdict::kRedo) << sharp.sentence;
    EXPECT_THAT(sharp.sentence, HasSubstr("blurred in 8 of 8"));
    EXPECT_THAT(sharp.advice, HasSubstr("Focus on the object"));
  }
}

TEST(QuickLook, TellsAnObjectThatIsDarkOrBurntOut) {
  RigSettings rig = smallRig();
  rig.exposure_gain = 0.15;
  const QuickFinding dark = finding(judged(rig), QuickAspect::kExposed);
  EXPECT_EQ(dark.verdict, QuickVerdict::kRedo);
  EXPECT_THAT(dark.advice, HasSubstr("Add light"));
  rig.exposure_gain = 2.5;
  const QuickFinding burnt = finding(judged(rig), QuickAspect::kExposed);
  EXPECT_EQ(burnt.verdict, QuickVerdict::kRedo);
  EXPECT_THAT(burnt.advice, HasSubstr("Dim the light"));
}

TEST(QuickLook, TellsAnObjectWithoutTexture) {
  RigSettings rig = smallRig();
  rig.object = "plain";
  const QuickLook look = judged(rig);
  EXPECT_EQ(finding(look, QuickAspect::kTextured).verdict, QuickVerdict::kRedo);
  EXPECT_THAT(finding(look, QuickAspect::kTextured).advice, HasSubstr("from its outlines"));
  expectGoodBut(look, QuickAspect::kTextured);
  EXPECT_THAT(look.views.front().fault, HasSubstr("texture"));
}

TEST(QuickLook, TellsAnObjectThatIsTooLarge) {
  RigSettings rig = smallRig();
  rig.object_size_mm = 180.0;
  const QuickLook look = judged(rig);
  EXPECT_EQ(finding(look, QuickAspect::kInPicture).verdict, QuickVerdict::kRedo);
  EXPECT_THAT(finding(look, QuickAspect::kInPicture).sentence, HasSubstr("cut off"));
  EXPECT_THAT(look.views.front().fault, HasSubstr("top"));
  expectGoodBut(look, QuickAspect::kInPicture);
}

TEST(QuickLook, TellsAnObjectThatStandsFarOffTheAxis) {
  RigSettings rig = smallRig();
  rig.object_offset_mm = 45.0;
  const QuickFinding off = finding(judged(rig), QuickAspect::kInPicture);
  EXPECT_EQ(off.verdict, QuickVerdict::kAcceptable);
  EXPECT_THAT(off.sentence, HasSubstr("mm off the axis"));
  EXPECT_THAT(off.advice, HasSubstr("middle of the table"));
  rig.object_offset_mm = 80.0;
  rig.object_size_mm = 140.0;
  const QuickFinding out = finding(judged(rig), QuickAspect::kInPicture);
  EXPECT_EQ(out.verdict, QuickVerdict::kRedo) << out.sentence;
}

TEST(QuickLook, TellsATableWithNothingOnIt) {
  const Seen seen = lookAround(smallRig());
  const std::vector<FramePtr> bare(kQuickViews, seen.empty);
  const auto look = judgeQuickLook(trueCalibration(smallRig()), seen.empty, bare, {});
  ASSERT_TRUE(look.ok()) << look.error().sentence();
  EXPECT_EQ(look->verdict, QuickVerdict::kRedo);
  EXPECT_THAT(look->findings[0].sentence, HasSubstr("No object"));
}

TEST(QuickLook, DoesNotJudgeWhatItCannotTellWithoutTheEmptyTable) {
  const Seen seen = lookAround(smallRig());
  const auto look = judgeQuickLook(trueCalibration(smallRig()), nullptr, seen.pictures, {});
  ASSERT_TRUE(look.ok()) << look.error().sentence();
  EXPECT_EQ(look->verdict, QuickVerdict::kAcceptable);
  EXPECT_THAT(finding(*look, QuickAspect::kInPicture).sentence, HasSubstr("not judged"));
  EXPECT_THAT(finding(*look, QuickAspect::kTextured).sentence, HasSubstr("not judged"));
  EXPECT_EQ(finding(*look, QuickAspect::kSharp).verdict, QuickVerdict::kGood);
}

TEST(QuickLook, RefusesWhatDoesNotBelongTogether) {
  const RigSettings rig = atImageWidth({}, 160);
  const Seen seen = lookAround(rig);
  const Calibration calibration = trueCalibration(rig);
  EXPECT_FALSE(judgeQuickLook(calibration, seen.empty, {}, {}).ok());
  EXPECT_FALSE(judgeQuickLook(trueCalibration(smallRig()), seen.empty, seen.pictures, {}).ok());
  Calibration nowhere = calibration;
  nowhere.cam_from_table.reset();
  EXPECT_FALSE(judgeQuickLook(nowhere, seen.empty, seen.pictures, {}).ok());
}

constexpr double kSpeed = 50.0;  // simulated seconds a second

// A simulated table and camera.
class TakeQuickLook : public testing::Test {
 protected:
  TakeQuickLook() : shaft_(std::make_shared<Shaft>()), firmware_({}, shaft_, SimClock(kSpeed)) {
    turntable_ = ProtocolTurntable::open(firmware_.openPort(), {}, {}).value();
    auto renderer = std::make_shared<const Renderer>(atImageWidth({}, 160));
    auto source = std::make_unique<SimCamera>(renderer, shaft_, SimClock(kSpeed));
    source->setTable(TableLoad::kObject);
    camera_.emplace(std::move(source));
  }
  std::shared_ptr<Shaft> shaft_;
  TurntableFirmware firmware_;
  std::unique_ptr<Turntable> turntable_;
  std::optional<StreamingCamera> camera_;
};

TEST_F(TakeQuickLook, LooksFromAllSidesAndKnowsWhereTheTableStands) {
  ASSERT_TRUE(turntable_->moveTo(radFromDeg(10.0), {}).ok());
  const TablePlace before = turntable_->place();
  int told = 0;
  const auto pictures =
      takeQuickLook(*turntable_, *camera_, [&told](const FramePtr&) { ++told; }, {});
  ASSERT_TRUE(pictures.ok()) << pictures.error().sentence();
  ASSERT_EQ(pictures->size(), static_cast<std::size_t>(kQuickViews));
  EXPECT_EQ(told, kQuickViews);
  for (int view = 0; view < kQuickViews; ++view) {
    EXPECT_NEAR((*pictures)[static_cast<std::size_t>(view)]->table_angle_rad,
                radFromDeg(10.0 + 45.0 * view), radFromDeg(0.1));
  }
  // It stands at 325 degrees, counted as -35: the way to a scan's first view is short.
  EXPECT_NEAR(turntable_->angleRad(), radFromDeg(-35.0), radFromDeg(0.1));
  EXPECT_EQ(shaft_->steps(), std::lround(3200.0 * 325.0 / 360.0));
  EXPECT_NEAR(*turntable_->angleAt(before), radFromDeg(10.0 - 360.0), radFromDeg(0.1));
}

TEST_F(TakeQuickLook, StopsOnRequestAndTheTableCanBeSentOn) {
  std::stop_source stop;
  const Task task(stop.get_token(), [&stop](double fraction, std::string_view) {
    if (fraction >= 2.0 / kQuickViews) stop.request_stop();
  });
  const auto pictures = takeQuickLook(
      *turntable_, *camera_, [](const FramePtr&) {}, task);
  ASSERT_FALSE(pictures.ok());
  EXPECT_EQ(pictures.error().code, Error::Code::kCancelled);
  EXPECT_LT(shaft_->steps(), 3200 / 2);
  ASSERT_TRUE(turntable_->moveTo(0.0, {}).ok());
  EXPECT_EQ(shaft_->steps(), 0);
}

}  // namespace
}  // namespace gyre
