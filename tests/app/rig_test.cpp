// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/rig.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

RigOptions small() {
  RigOptions options;
  options.sim = atImageWidth(RigSettings{}, 160);
  options.sim_speed = 50.0;
  return options;
}

TEST(OpenRig, BuildsASimulatedRoomWhoseCameraSeesItsTable) {
  auto rig = openRig("sim:cube", "sim", small(), {});
  ASSERT_TRUE(rig) << rig.error().sentence();
  EXPECT_EQ(rig->room->settings.object, "cube");
  EXPECT_NE(rig->turntable->info().firmware.find("Grbl"), std::string::npos);
  rig->room->setTable(TableLoad::kObject);
  ASSERT_TRUE(rig->turntable->moveTo(radFromDeg(90.0), {}));
  const auto frame = rig->camera->grabAfter(steadySeconds(), {});
  ASSERT_TRUE(frame);
  const Frame truth = rig->room->renderer->render(rig->room->shaft->steps(), TableLoad::kObject);
  EXPECT_TRUE(std::equal(truth.image_bgr.datastart, truth.image_bgr.dataend,
                         (*frame)->image_bgr.datastart));
}

TEST(OpenRig, TakesAFolderOfPicturesForACamera) {
  const TempDir temp;
  ASSERT_TRUE(writePicture(temp / "1.png", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(5))));
  auto rig = openRig("sim", temp.path().string(), small(), {});
  ASSERT_TRUE(rig) << rig.error().sentence();
  EXPECT_EQ(rig->camera->grabAfter(steadySeconds(), {}).value()->image_bgr.cols, 30);
}

TEST(OpenRig, RefusesInWordsWhatDoesNotFitTogether) {
  const RigOptions options = small();
  EXPECT_EQ(openRig("/dev/null", "sim", options, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(openRig("sim:ghost", "sim", options, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(openRig("sim", "/dev/video987", options, {}).error().code, Error::Code::kNotFound);
  EXPECT_FALSE(openRig("tcp:127.0.0.1:1", "sim", options, {}));
  RigOptions odd = options;
  odd.camera_mode = "huge";
  EXPECT_EQ(openRig("sim", "/dev/video0", odd, {}).error().code, Error::Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
