// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reconstruct.h"

#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_file.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr int kViews = 8;
constexpr double kStep_deg = 5.0;

// A folder of pictures of the cylinder, with calibration and angles beside it.
class Reconstruct : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(pictures());
    AngleTable angles;
    for (int view = 0; view < kViews; ++view) {
      char name[16];
      std::snprintf(name, sizeof name, "v%d.png", view + 1);
      const double angle_rad = radFromDeg(kStep_deg * view);
      ASSERT_TRUE(writePicture(pictures() / name, world_.render(angle_rad).image_bgr));
      angles[name] = angle_rad;
    }
    ASSERT_TRUE(writePicture(dir_.path() / "empty.png", world_.renderEmpty().image_bgr));
    ASSERT_TRUE(writeCalibration(dir_.path() / "calibration.json", world_.calibration()));
    ASSERT_TRUE(writeAngles(dir_.path() / "angles.csv", angles));
  }

  fs::path pictures() const { return dir_.path() / "pictures"; }

  PictureSet set() const {
    PictureSet set;
    set.pictures = pictures();
    set.calibration = dir_.path() / "calibration.json";
    set.angles = dir_.path() / "angles.csv";
    set.background = dir_.path() / "empty.png";
    return set;
  }

  void writeText(const std::string& name, const std::string& text) const {
    std::ofstream(dir_.path() / name) << text;
  }

  test::TurningCylinder world_;
  TempDir dir_;
};

TEST_F(Reconstruct, GivesTheCylinderFromAFolder) {
  const auto prepared = preparePictures(set());
  ASSERT_TRUE(prepared) << prepared.error().sentence();
  int frames = 0;
  const auto result = reconstruct(
      *prepared, {}, [&](const TrackedFrame&) { ++frames; }, Task());
  ASSERT_TRUE(result) << result.error().sentence();
  EXPECT_EQ(frames, kViews);
  EXPECT_GT(result->cloud.points.size(), 100U);
}

TEST_F(Reconstruct, TakesAStepInsteadOfAngles) {
  PictureSet stepped = set();
  stepped.angles.clear();
  stepped.step_rad = radFromDeg(kStep_deg);
  const auto prepared = preparePictures(stepped);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->views[3].name, "v4.png");
  EXPECT_NEAR(prepared->views[3].table_angle_rad, radFromDeg(15), 1e-12);
}

TEST_F(Reconstruct, SaysWhatIsMissing) {
  PictureSet nothing = set();
  nothing.pictures = dir_.path() / "nowhere";
  EXPECT_EQ(preparePictures(nothing).error().code, Error::Code::kNotFound);
  std::ofstream(dir_.path() / "hand-held.json")
      << R"({"format": "gyre-calibration", "version": 1, "image_size": [400, 300],
             "camera": {"fx": 600, "fy": 600, "skew": 0, "cx": 199.5, "cy": 149.5,
                        "distortion": {"model": "brown", "k1": 0, "k2": 0, "p1": 0, "p2": 0,
                                       "k3": 0}}, "cam_from_table": null})";
  PictureSet without_table = set();
  without_table.calibration = dir_.path() / "hand-held.json";
  EXPECT_NE(preparePictures(without_table).error().what.find("table"), std::string::npos);
}

TEST_F(Reconstruct, BelievesAnglesThatAreNamedBeforeItIsToldToFindThem) {
  PictureSet both = set();
  EXPECT_TRUE(preparePictures(both)->angles_told);
  both.angles.clear();
  both.find_steps = true;
  EXPECT_FALSE(preparePictures(both)->angles_told);
}

TEST_F(Reconstruct, TakesPicturesOfWhichNothingIsKnown) {
  PictureSet bare;
  bare.pictures = pictures();
  const auto prepared = preparePictures(bare);
  ASSERT_TRUE(prepared) << prepared.error().sentence();
  EXPECT_FALSE(prepared->angles_told);
  EXPECT_FALSE(prepared->calibration.calibration.cam_from_table);
  EXPECT_EQ(prepared->views[2].name, "v3.png");
  // Camera and angles must be found first.
  const auto refused = reconstruct(*prepared, {}, {}, Task());
  ASSERT_FALSE(refused);
}

TEST_F(Reconstruct, RefusesAnglesThatAreMissingDoubleOrAllTheSame) {
  PictureSet with = set();
  with.angles = dir_.path() / "bad.csv";
  writeText("bad.csv", "image,angle_deg\nv1.png,0\nv2.png,5\n");
  EXPECT_FALSE(preparePictures(with));
  writeText("bad.csv", "image,angle_deg\nv1.png,0\nv1.png,5\n");
  EXPECT_FALSE(preparePictures(with));
  std::string same = "image,angle_deg\n";
  for (int view = 1; view <= kViews; ++view) same += "v" + std::to_string(view) + ".png,30\n";
  writeText("bad.csv", same);
  const auto refused = preparePictures(with);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("same table angle"), std::string::npos);
}

TEST_F(Reconstruct, RefusesACalibrationOfAnotherPictureSize) {
  Calibration other = world_.calibration();
  other.camera.width_px = 800;
  ASSERT_TRUE(writeCalibration(dir_.path() / "calibration.json", other));
  const auto refused = preparePictures(set());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("400 x 300"), std::string::npos);
}

TEST_F(Reconstruct, RefusesPicturesOfMixedSizesAndTruncatedOnes) {
  ASSERT_TRUE(writePicture(pictures() / "v3.png", cv::Mat::zeros(60, 80, CV_8UC3)));
  EXPECT_FALSE(preparePictures(set()));
  ASSERT_TRUE(writePicture(pictures() / "v3.png", world_.render(0).image_bgr));
  fs::resize_file(pictures() / "v3.png", 2000);
  const auto prepared = preparePictures(set());
  EXPECT_TRUE(!prepared || !reconstruct(*prepared, {}, {}, Task()));
}

TEST_F(Reconstruct, StopsWhenAsked) {
  const auto prepared = preparePictures(set());
  ASSERT_TRUE(prepared);
  std::stop_source stop;
  stop.request_stop();
  const auto result = reconstruct(*prepared, {}, {}, Task(stop.get_token()));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
