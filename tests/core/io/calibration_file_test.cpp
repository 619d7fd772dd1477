// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/calibration_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

Calibration oddCalibration() {
  Calibration calibration;
  CameraModel& camera = calibration.camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx = 1500.0 + 1.0 / 3.0;
  camera.fy = 1499.9;
  camera.skew = -0.0;
  camera.cx = 639.5;
  camera.cy = 479.123456789012345;
  camera.k1 = -0.08;
  camera.k2 = 1e-17;
  camera.p1 = -3.3e-5;
  camera.p2 = 0.1 + 0.2;
  camera.k3 = 5e-324;
  Rigid3 cam_from_table;
  cam_from_table.rotation =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  cam_from_table.translation = Eigen::Vector3d(1.0 / 7.0, -20.0, 350.0);
  calibration.cam_from_table = cam_from_table;
  return calibration;
}

constexpr const char* kProductExample = R"({ "format": "gyre-calibration", "version": 1,
  "image_size": [1280, 960],
  "camera": { "fx": 1500.0, "fy": 1500.0, "skew": 0.0, "cx": 639.5, "cy": 479.5,
              "distortion": { "model": "brown", "k1": -0.08, "k2": 0.0, "p1": 0.0, "p2": 0.0,
                              "k3": 0.0 } },
  "cam_from_table": { "rotation": [[1,0,0],[0,-1,0],[0,0,-1]], "translation_mm": [0, 0, 350] },
  "date": "2026-01-01", "residuals": [1, 2, 3] })";

// The example with one piece replaced.
std::string exampleWith(const std::string& piece, const std::string& replacement) {
  std::string text = kProductExample;
  const std::size_t at = text.find(piece);
  GYRE_CHECK(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

TEST(WriteCalibration, KeepsEveryBit) {
  const TempDir dir;
  const Calibration calibration = oddCalibration();
  ASSERT_TRUE(writeCalibration(dir / "Kalibrierung ö.json", calibration));
  const auto back = readCalibration(dir / "Kalibrierung ö.json");
  ASSERT_TRUE(back) << back.error().sentence();
  const CameraModel& a = calibration.camera;
  const CameraModel& b = back->camera;
  EXPECT_EQ(b.width_px, a.width_px);
  EXPECT_EQ(b.height_px, a.height_px);
  for (const auto field :
       {&CameraModel::fx, &CameraModel::fy, &CameraModel::skew, &CameraModel::cx, &CameraModel::cy,
        &CameraModel::k1, &CameraModel::k2, &CameraModel::p1, &CameraModel::p2, &CameraModel::k3}) {
    EXPECT_EQ(b.*field, a.*field);
    EXPECT_EQ(std::signbit(b.*field), std::signbit(a.*field));
  }
  ASSERT_TRUE(back->cam_from_table);
  EXPECT_EQ(back->cam_from_table->rotation, calibration.cam_from_table->rotation);
  EXPECT_EQ(back->cam_from_table->translation, calibration.cam_from_table->translation);
}

TEST(WriteCalibration, KeepsThatThereIsNoTable) {
  Calibration calibration = oddCalibration();
  calibration.cam_from_table.reset();
  const auto back = parseCalibration(calibrationText(calibration), "f");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_FALSE(back->cam_from_table);
}

TEST(WriteCalibration, RefusesWhatItCouldNotReadAndLeavesTheFile) {
  const TempDir dir;
  const auto file = putFile(dir / "calibration.json", "old");
  Calibration calibration = oddCalibration();
  calibration.camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(writeCalibration(file, calibration));
  calibration = oddCalibration();
  calibration.cam_from_table->rotation(0, 0) += 0.01;
  EXPECT_FALSE(writeCalibration(file, calibration));
  EXPECT_EQ(fileText(file), "old");
}

TEST(ParseCalibration, ReadsThePublishedFormAndPassesOverWhatItDoesNotKnow) {
  const auto calibration = parseCalibration(kProductExample, "f");
  ASSERT_TRUE(calibration) << calibration.error().sentence();
  EXPECT_EQ(calibration->camera.width_px, 1280);
  EXPECT_EQ(calibration->camera.k1, -0.08);
  EXPECT_EQ(calibration->cam_from_table->translation.z(), 350.0);
  EXPECT_TRUE(parseCalibration("\xEF\xBB\xBF" + std::string(kProductExample), "f"));
}

TEST(ParseCalibration, TellsWhatIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "is damaged"},
      {"[]", "\"format\""},
      {"{", "is damaged"},
      {exampleWith("gyre-calibration", "opencv"), "\"format\""},
      {exampleWith("\"version\": 1", "\"version\": 2"), "version"},
      {exampleWith("\"version\": 1,", ""), "version"},
      {exampleWith("1500.0", "NaN"), "NaN"},
      {exampleWith("1500.0", "-Infinity"), "Infinity"},
      {exampleWith("1500.0", "1e999"), "too large"},
      {exampleWith("1500.0", "1e12"), "\"fx\""},
      {exampleWith("1500.0", "\"1500\""), "\"fx\""},
      {exampleWith("1500.0", "true"), "\"fx\""},
      {exampleWith("1500.0", "0"), "focal length"},
      {exampleWith("1500.0", "-1500"), "focal length"},
      {exampleWith("\"cy\": 479.5,", ""), "\"cy\""},
      {exampleWith("\"cx\": 639.5", "\"cx\": 1e9"), "\"cx\""},
      {exampleWith("brown", "fisheye"), "distortion model"},
      {exampleWith("\"k1\": -0.08", "\"k1\": 1e200"), "\"k1\""},
      {exampleWith("\"k2\": 0.0,", ""), "\"k2\""},
      {exampleWith("\"distortion\"", "\"undistortion\""), "\"distortion\""},
      {exampleWith("[1280, 960]", "[1280]"), "2 entries"},
      {exampleWith("[1280, 960]", "[1280, 0]"), "\"image_size\""},
      {exampleWith("[1280, 960]", "[-1280, 960]"), "\"image_size\""},
      {exampleWith("[1280, 960]", "[1280.5, 960]"), "\"image_size\""},
      {exampleWith("[1280, 960]", "[1280, 1e8]"), "\"image_size\""},
      {exampleWith("[1280, 960]", "\"1280x960\""), "2 entries"},
      {exampleWith("\"camera\"", "\"lens\""), "\"camera\""},
      {exampleWith("\"cam_from_table\"", "\"pose\""), "\"cam_from_table\""},
      {exampleWith("[[1,0,0],[0,-1,0],[0,0,-1]]", "[[1,0,0],[0,-1,0]]"), "3 entries"},
      {exampleWith("[[1,0,0],[0,-1,0],[0,0,-1]]", "[1,0,0]"), "3 entries"},
      {exampleWith("[0,-1,0]", "[0,-1]"), "3 entries"},
      {exampleWith("[0,-1,0]", "[0,1,0]"), "not a rotation"},
      {exampleWith("[0,-1,0]", "[0,-0.99,0]"), "not a rotation"},
      {exampleWith("[0,-1,0]", "[0,null,0]"), "\"rotation\""},
      {exampleWith("[0, 0, 350]", "[0, 0]"), "3 entries"},
      {exampleWith("[0, 0, 350]", "[0, 0, 1e7]"), "\"translation_mm\""},
      {exampleWith("{ \"rotation\"", "{ \"turn\""), "\"rotation\""},
  };
  for (const auto& [text, problem] : cases) {
    const auto calibration = parseCalibration(text, "rig.json");
    ASSERT_FALSE(calibration) << text;
    EXPECT_EQ(calibration.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(calibration.error().what, HasSubstr("rig.json"));
    EXPECT_THAT(calibration.error().what, HasSubstr(problem)) << text;
    EXPECT_FALSE(calibration.error().advice.empty());
  }
}

TEST(ReadCalibration, NamesTheMissingFile) {
  EXPECT_EQ(readCalibration("/nowhere/c.json").error().code, Error::Code::kNotFound);
}

TEST(ParseCalibration, SurvivesDamage) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto calibration = parseCalibration(mutated(kProductExample, seed), "f");
    if (!calibration) {
      EXPECT_FALSE(calibration.error().what.empty());
    } else {
      EXPECT_GT(calibration->camera.fx, 0.0);
    }
  }
}

}  // namespace
}  // namespace gyre
