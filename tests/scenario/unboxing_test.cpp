// The whole way from unboxing to a measured model, by commands alone, as on real devices: the port
// is a pseudo terminal whose board is set up for other steps per turn and the other direction, the
// camera an HTTP server on loopback. The truth comes from the simulator.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "app/rig.h"
#include "app/sim_target.h"
#include "core/base/clock.h"
#include "core/io/calibration_record_file.h"
#include "core/io/picture_file.h"
#include "core/io/ply.h"
#include "core/io/scan_store.h"
#include "core/sim/renderer.h"
#include "core/sim/truth.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/command_answer.h"
#include "tests/support/mjpeg_server.h"
#include "tests/support/needs_pty.h"
#include "tests/support/pty_port.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

const auto* const kNeedsPty = testing::AddGlobalTestEnvironment(new test::NeedsPty);

using test::Answer;
using test::gyre;
using testing::HasSubstr;

constexpr int kViews = 36;
constexpr int kWidth_px = 960;
// The board believes in so many steps for each that a turn has.
constexpr double kBelieved = 1.5;
// Between the duck and its points: seen 0.011 in the middle and 0.026 on average, from pictures of
// a network camera and with all that was calibrated by it. [mm]
constexpr double kMedian_mm = 0.03;
constexpr double kMean_mm = 0.08;

enum class OnTable { kTarget, kNothing, kObject };

RigSettings desk() {
  RigSettings rig = atImageWidth(RigSettings{}, kWidth_px);
  rig.motor_direction = -1;
  return rig;
}

RigSettings deskWithTarget() {
  RigSettings rig = desk();
  rig.object = "target";
  rig.target = "wedge";
  return rig;
}

// What stands on the desk. The program reaches it by port and network only; the hand that puts
// things on the table is the test's.
class Desk {
 public:
  Desk()
      : shaft_(std::make_shared<Shaft>()),
        firmware_(wrongBoard(), shaft_, SimClock(20.0)),
        scene_(desk()),
        target_scene_(deskWithTarget(), simulatedTarget(deskWithTarget()).value()),
        camera_([this](int) { return picture(); }, 15.0) {
    auto device = PtyPort::make();
    port_ = device->path();
    device->onOpened([this] { firmware_.pressReset(); });
    firmware_.attach(std::move(device));
  }

  void put(OnTable what) { what_ = what; }
  const std::string& port() const { return port_; }
  std::string cameraUrl() const { return camera_.url(); }
  const Renderer& scene() const { return scene_; }
  std::int64_t steps() const { return shaft_->steps(); }

 private:
  static TurntableFirmwareOptions wrongBoard() {
    TurntableFirmwareOptions board;
    board.steps_per_turn = kBelieved * RigSettings{}.steps_per_turn;
    return board;
  }
  // Rendered once for each place and load: at rest a picture costs nothing.
  cv::Mat picture() {
    const OnTable what = what_;
    const std::int64_t steps = shaft_->steps();
    if (shown_.empty() || steps != shown_steps_ || what != shown_what_) {
      const Renderer& scene = what == OnTable::kTarget ? target_scene_ : scene_;
      const TableLoad load = what == OnTable::kNothing ? TableLoad::kEmpty : TableLoad::kObject;
      shown_ = scene.render(steps, load).image_bgr;
      shown_steps_ = steps;
      shown_what_ = what;
    }
    return shown_;
  }

  std::shared_ptr<Shaft> shaft_;
  TurntableFirmware firmware_;
  Renderer scene_;
  Renderer target_scene_;
  std::atomic<OnTable> what_{OnTable::kTarget};
  cv::Mat shown_;  // of the camera's thread alone, like the two below
  std::int64_t shown_steps_ = 0;
  OnTable shown_what_ = OnTable::kTarget;
  std::string port_;
  test::MjpegServer camera_;
};

class Unboxing : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return (temp_ / name).string(); }

  // As any program that shows the camera's picture saves one.
  void photographEmptyTable() const {
    const RigOptions options;
    const auto camera = openCamera(desk_.cameraUrl(), options, nullptr);
    ASSERT_TRUE(camera) << camera.error().sentence();
    const auto picture = (*camera)->grabAfter(steadySeconds(), {});
    ASSERT_TRUE(picture) << picture.error().sentence();
    ASSERT_TRUE(writePicture(temp_ / "empty.png", (*picture)->image_bgr));
  }

  // The duck as the scan has it, whose angle 0 is where the table stood when it began.
  void writeTruth(const ScanStore& store, std::int64_t steps_at_begin) const {
    std::vector<std::int64_t> shaft_at_views;
    for (const CapturedView& view : store.views()) {
      // Counted in the table's direction, which is against the motor's.
      shaft_at_views.push_back(steps_at_begin - view.steps);
    }
    auto truth = truthOf(desk_.scene(), shaft_at_views, {});
    ASSERT_TRUE(truth) << truth.error().sentence();
    const double begin_rad = trueAngleRad(desk_.scene().rig(), steps_at_begin);
    const Eigen::Matrix3d scan_from_truth =
        Eigen::AngleAxisd(begin_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (auto& vertex : truth->mesh.vertices) {
      vertex.position = scan_from_truth * vertex.position;
      vertex.normal = scan_from_truth * vertex.normal;
    }
    ASSERT_TRUE(writePly(temp_ / "truth.ply", truth->mesh, MeshKind::kTruth));
  }

  TempDir temp_;
  Desk desk_;
};

TEST_F(Unboxing, LeadsByCommandsFromAnUnknownBoardToAMeasuredModel) {
  // What is there? Nothing is opened, nothing moves.
  EXPECT_EQ(gyre({"devices"}).code, 0);
  const Answer probed = gyre({"devices", "--probe", desk_.port(), "--json"});
  ASSERT_EQ(probed.code, 0) << probed.err;
  const auto found = nlohmann::json::parse(probed.out);
  EXPECT_EQ(found.at("state"), "turntable");
  EXPECT_EQ(found.at("firmware"), "Grbl 1.1h");
  EXPECT_NEAR(found.at("steps_per_turn").get<double>(), 4800.0, 0.5);
  EXPECT_EQ(desk_.steps(), 0);

  // The target stands on the table: how does it turn, and where is the camera?
  const Answer calibrated =
      gyre({"calibrate", "--turntable", desk_.port(), "--camera", desk_.cameraUrl(), "--target",
            "wedge", "--pictures", "12", "--out", at("calibration.json")});
  ASSERT_EQ(calibrated.code, 0) << calibrated.err << calibrated.out;
  EXPECT_THAT(calibrated.out + calibrated.err, HasSubstr("clockwise"));
  const auto record = readCalibrationRecord(temp_ / "calibration.json");
  ASSERT_TRUE(record) << record.error().sentence();
  ASSERT_TRUE(record->turntable);
  EXPECT_EQ(record->turntable->direction, -1);
  EXPECT_NEAR(record->turntable->units_per_turn, 360.0 / kBelieved, 0.3);

  // The table is cleared, photographed, and the duck stands on it.
  desk_.put(OnTable::kNothing);
  photographEmptyTable();
  desk_.put(OnTable::kObject);
  const std::int64_t begin = desk_.steps();
  const Answer scanned =
      gyre({"scan", "--turntable", desk_.port(), "--camera", desk_.cameraUrl(), "--calibration",
            at("calibration.json"), "--background", at("empty.png"), "--views",
            std::to_string(kViews), "--out", at("scan")});
  ASSERT_EQ(scanned.code, 0) << scanned.err << scanned.out;
  const auto store = ScanStore::open(temp_ / "scan");
  ASSERT_TRUE(store && store->complete());
  for (const CapturedView& view : store->views()) {
    const double turned_rad = trueAngleRad(desk_.scene().rig(), begin - view.steps) -
                              trueAngleRad(desk_.scene().rig(), begin);
    EXPECT_NEAR(view.table_angle_rad, turned_rad, 0.004) << "view " << view.view;
  }
  for (const char* file : {"points.ply", "mesh.ply", "mesh.obj", "report.json", "report.html"}) {
    EXPECT_TRUE(std::filesystem::exists(temp_ / "scan" / file)) << file;
  }

  // How far is it from the truth?
  writeTruth(*store, begin);
  const Answer compared =
      gyre({"compare", at("scan/points.ply"), at("truth.ply"), "--json", at("compared.json")});
  ASSERT_EQ(compared.code, 0) << compared.err;
  const auto accuracy = nlohmann::json::parse(fileText(temp_ / "compared.json")).at("accuracy_mm");
  EXPECT_LT(accuracy.at("median").get<double>(), kMedian_mm);
  EXPECT_LT(accuracy.at("mean").get<double>(), kMean_mm);
  RecordProperty("median_um", static_cast<int>(1000.0 * accuracy.at("median").get<double>()));
  RecordProperty("mean_um", static_cast<int>(1000.0 * accuracy.at("mean").get<double>()));
}

}  // namespace
}  // namespace gyre
