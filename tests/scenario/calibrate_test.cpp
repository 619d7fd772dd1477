// gyre calibrate on the simulated rig, on good and bad pictures, and what it says to wrong use.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "app/cli/command_line.h"
#include "app/sim_target.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/io/calibration_record_file.h"
#include "core/io/picture_file.h"
#include "core/sim/renderer.h"
#include "core/sim/rig_json.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Answer {
  int code = 0;
  std::string out;
  std::string err;
};

Answer gyre(const std::vector<std::string>& words) {
  std::ostringstream out;
  std::ostringstream err;
  Console console(out, err, ProgressStyle::kLines);
  const int code = runCommandLine(words, console, {});
  return {code, out.str(), err.str()};
}

// The default rig with a target on its table.
RigSettings wedgeRig() {
  RigSettings rig;
  rig.object = "target";
  rig.target = "wedge";
  return rig;
}

// Twelve pictures of a turn, as any camera could have taken them.
const std::vector<cv::Mat>& turnOfTheWedge() {
  static const std::vector<cv::Mat> kPictures = [] {
    const RigSettings rig = wedgeRig();
    const Renderer renderer(rig, simulatedTarget(rig).value());
    std::vector<cv::Mat> pictures;
    for (int i = 0; i < 12; ++i) {
      pictures.push_back(
          renderer.render(rig.steps_per_turn * i / 12, TableLoad::kObject).image_bgr);
    }
    return pictures;
  }();
  return kPictures;
}

class Calibrate : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return (temp_ / name).string(); }

  std::string pictures(const std::function<cv::Mat(const cv::Mat&)>& spoil = {}) const {
    fs::create_directories(temp_ / "pictures");
    for (std::size_t i = 0; i < turnOfTheWedge().size(); ++i) {
      const cv::Mat& clean = turnOfTheWedge()[i];
      EXPECT_TRUE(writePicture(temp_ / "pictures" / (std::to_string(i) + ".png"),
                               spoil ? spoil(clean) : clean));
    }
    return at("pictures");
  }

  Answer live(const RigSettings& rig, std::vector<std::string> more = {}) const {
    putFile(temp_ / "rig.json", rigToJson(rig));
    std::vector<std::string> words = {
        "calibrate",    "--turntable", "sim",   "--camera",
        "sim",          "--target",    "wedge", "--rig",
        at("rig.json"), "--sim-speed", "50",    "--pictures",
        "12",           "--verbose",   "--out", at("calibration.json")};
    words.insert(words.end(), more.begin(), more.end());
    return gyre(words);
  }

  void expectFailure(const std::vector<std::string>& words, int code,
                     const std::string& part) const {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, code) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr(part));
    EXPECT_FALSE(fs::exists(temp_ / "calibration.json"));
  }
  std::vector<std::string> folderWords(const std::string& folder,
                                       const std::string& target = "wedge") const {
    return {"calibrate", folder, "--target", target, "--out", at("calibration.json")};
  }

  TempDir temp_;
};

// The axis's tilt against the truth, yaw and height left aside. [rad]
double tiltOff(const Calibration& found, const RigSettings& rig) {
  const Calibration truth = trueCalibration(rig);
  return std::acos(std::min(
      1.0, found.cam_from_table->rotation.col(2).dot(truth.cam_from_table->rotation.col(2))));
}

TEST_F(Calibrate, MeasuresTheRigFromPicturesWithoutAngles) {
  const Answer answer = gyre(folderWords(pictures()));
  EXPECT_EQ(answer.code, 0) << answer.err << answer.out;
  EXPECT_THAT(answer.out, HasSubstr("Verdict: acceptable"));
  EXPECT_THAT(answer.out, HasSubstr("size not verified"));
  EXPECT_THAT(answer.out, HasSubstr("local detail"));
  const auto record = readCalibrationRecord(temp_ / "calibration.json");
  ASSERT_TRUE(record) << record.error().sentence();
  // The judged limit of 24 pictures is 0.05 %; these are twelve.
  EXPECT_NEAR(record->calibration.camera.fx, wedgeRig().focal_px, 0.001 * wedgeRig().focal_px);
  EXPECT_LT(tiltOff(record->calibration, wedgeRig()), radFromDeg(0.05));
  EXPECT_EQ(record->target, "wedge");
  EXPECT_FALSE(record->turntable);
}

TEST_F(Calibrate, VerifiesTheSizeByTheRulers) {
  std::vector<std::string> words = folderWords(pictures());
  words.insert(words.end(), {"--ruler-right", "100", "--ruler-down", "100"});
  const Answer answer = gyre(words);
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_THAT(answer.out, testing::Not(HasSubstr("size not verified")));
}

TEST_F(Calibrate, NamesWhatSpoilsThePictures) {
  const auto blurred = [](const cv::Mat& clean) {
    cv::Mat out;
    cv::GaussianBlur(clean, out, {}, 12.0);
    return out;
  };
  const auto overexposed = [](const cv::Mat& clean) -> cv::Mat {
    return 8.0 * clean + cv::Scalar::all(220.0);
  };
  const auto cut_off = [](const cv::Mat& clean) {
    cv::Mat out = clean.clone();
    out(cv::Rect(0, 0, out.cols, out.rows * 7 / 10)).setTo(90);
    return out;
  };
  const auto absent = [](const cv::Mat& clean) {
    return cv::Mat(clean.size(), clean.type(), cv::Scalar::all(120));
  };
  expectFailure(folderWords(pictures(blurred)), 1, "blurred");
  expectFailure(folderWords(pictures(overexposed)), 1, "over-exposed");
  expectFailure(folderWords(pictures(cut_off)), 1, "The target was found in only");
  expectFailure(folderWords(pictures(absent)), 1, "The target was found in only");
  expectFailure(folderWords(pictures(), "coded-cube"), 1, "coded-cube");
}

TEST_F(Calibrate, FindsWrongStepsAndAReversedMotor) {
  RigSettings rig = wedgeRig();
  rig.firmware_steps_per_turn = 2.0 * rig.steps_per_turn;
  rig.motor_direction = -1;
  const Answer answer = live(rig, {"--keep", at("kept")});
  ASSERT_EQ(answer.code, 0) << answer.err << answer.out;
  EXPECT_THAT(answer.out, HasSubstr("clockwise"));
  const auto record = readCalibrationRecord(temp_ / "calibration.json");
  ASSERT_TRUE(record) << record.error().sentence();
  ASSERT_TRUE(record->turntable);
  EXPECT_NEAR(record->turntable->units_per_turn, 180.0, 0.2);
  EXPECT_EQ(record->turntable->direction, -1);
  EXPECT_NEAR(record->calibration.camera.fx, rig.focal_px, 0.001 * rig.focal_px);
  EXPECT_LT(tiltOff(record->calibration, rig), radFromDeg(0.05));
  EXPECT_TRUE(fs::exists(temp_ / "calibration.png"));
  EXPECT_TRUE(fs::exists(temp_ / "kept" / "angles.csv"));
}

TEST_F(Calibrate, SaysThatTheTargetIsNotThere) {
  RigSettings rig = wedgeRig();
  rig.object = "mouse";
  rig.target = "";
  const Answer answer = live(rig);
  EXPECT_EQ(answer.code, 1);
  EXPECT_FALSE(fs::exists(temp_ / "calibration.json"));
}

TEST_F(Calibrate, ComputesFromKnownCorners) {
  const Calibration truth = trueCalibration({});
  std::ostringstream lines;
  lines.precision(12);
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = 0; z <= 3; ++z) {
        const Eigen::Vector3d point(12.0 * x, 12.0 * y, 12.0 * z);
        const auto pixel = truth.camera.project(*truth.cam_from_table * point);
        lines << point.transpose() << ' ' << pixel->transpose() << '\n';
      }
    }
  }
  putFile(temp_ / "points.txt", lines.str());
  const Answer answer = gyre({"calibrate", "--points", at("points.txt"), "--image-size", "1280x960",
                              "--out", at("calibration.json")});
  EXPECT_EQ(answer.code, 0) << answer.err;
  const auto record = readCalibrationRecord(temp_ / "calibration.json");
  ASSERT_TRUE(record);
  EXPECT_NEAR(record->calibration.camera.fx, 2400.0, 0.1);
  EXPECT_NEAR(record->calibration.camera.k1, -0.08, 1e-3);
}

TEST_F(Calibrate, AnswersWrongUseWithTwo) {
  const std::string out = at("calibration.json");
  expectFailure({"calibrate", "--out", out}, 2, "Nothing says what");
  expectFailure({"calibrate", "pictures", "--out", out}, 2, "which target");
  expectFailure({"calibrate", "pictures", "--points", "p", "--out", out}, 2, "Two ways");
  expectFailure({"calibrate", "--turntable", "sim", "--target", "wedge", "--out", out}, 2,
                "--camera");
  expectFailure({"calibrate", "p", "--target", "wedge", "--ruler-right", "99", "--out", out}, 2,
                "Measure both");
}

TEST_F(Calibrate, AnswersBadFilesWithOne) {
  const std::string out = at("calibration.json");
  expectFailure(folderWords(at("nowhere")), 1, "nowhere");
  fs::create_directories(temp_ / "empty");
  expectFailure(folderWords(at("empty")), 1, "empty");
  expectFailure(folderWords(at("empty"), "no-such-target"), 1, "no-such-target");
  putFile(temp_ / "broken.json", "{");
  expectFailure(folderWords(at("empty"), at("broken.json")), 1, "broken.json");
  expectFailure({"calibrate", at("empty"), "--target", "wedge", "--intrinsics", at("broken.json"),
                 "--out", out},
                1, "broken.json");
  putFile(temp_ / "few.txt", "0 0 0 1 1\n");
  expectFailure({"calibrate", "--points", at("few.txt"), "--out", out}, 1, "few.txt");
  expectFailure({"calibrate", "--points", at("few.txt"), "--image-size", "large", "--out", out}, 1,
                "large");
}

}  // namespace
}  // namespace gyre
