// A whole scan with a ring of markers under the object, on a table that errs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/scan_session.h"
#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/scan_store.h"
#include "tests/support/command_answer.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kViews = 24;

RigOptions ringRig() {
  RigOptions options;
  options.sim = atImageWidth(options.sim, 640);
  options.sim.target = "ring";
  options.sim.once_per_turn_error_deg = 0.4;
  options.sim_speed = 50.0;
  return options;
}

// Scans in the window's way; gives the number of points.
std::size_t scanInto(const fs::path& folder, const RigOptions& options,
                     const CalibrationRecord& record) {
  auto rig = openRig("sim", "sim", options, {});
  EXPECT_TRUE(rig) << rig.error().sentence();
  ScanPlan plan;
  plan.folder = folder;
  plan.settings.views = kViews;
  plan.calibration = record;
  const auto done = runScanSession(*rig, plan, {}, {});
  EXPECT_TRUE(done) << done.error().sentence();
  return done ? done->reconstruction.cloud.points.size() : 0;
}

// How far the angles of a file are from where the table truly stood. [deg]
double rmsOffDeg(const fs::path& folder, const std::string& file, const RigSettings& rig) {
  const auto angles = readAngles(folder / file);
  const auto store = ScanStore::open(folder);
  EXPECT_TRUE(angles && store);
  double squares = 0.0;
  for (const CapturedView& view : store->views()) {
    squares += std::pow(angles->at(view.file) - trueAngleRad(rig, view.steps), 2);
  }
  return degFromRad(std::sqrt(squares / static_cast<double>(store->views().size())));
}

class RingScan : public testing::Test {
 protected:
  TempDir temp_;
};

TEST_F(RingScan, MeasuresAtTheAnglesThatTheRingShows) {
  const RigOptions options = ringRig();
  const std::size_t with = scanInto(temp_ / "with", options, trueRecord(options.sim));
  const std::size_t without = scanInto(temp_ / "without", options, trueCalibration(options.sim));
  EXPECT_GT(rmsOffDeg(temp_ / "with", "angles.csv", options.sim), 0.1);
  const double by_ring_deg = rmsOffDeg(temp_ / "with", "angles_solved.csv", options.sim);
  EXPECT_LT(by_ring_deg, 0.01);
  // The object's own features tell the angles too, but not as well.
  const double by_features_deg = rmsOffDeg(temp_ / "without", "angles_solved.csv", options.sim);
  EXPECT_LT(by_features_deg, 0.3 * rmsOffDeg(temp_ / "without", "angles.csv", options.sim));
  EXPECT_GT(by_features_deg, by_ring_deg) << by_ring_deg;
  EXPECT_GT(with, without / 2);

  const auto report = nlohmann::json::parse(fileText(temp_ / "with/report.json"));
  EXPECT_EQ(report["turning"]["views"].size(), std::size_t{kViews});
  EXPECT_GT(report["turning"]["rms_off_deg"].get<double>(), 0.1);
  EXPECT_THAT(report["turning"]["sentence"].get<std::string>(), HasSubstr("24 of 24 views"));
  EXPECT_THAT(report["drift"]["sentence"].get<std::string>(), HasSubstr("So did the turntable"));
  EXPECT_EQ(report["drift"]["platter"].size(), std::size_t{kViews});
  const auto told = nlohmann::json::parse(fileText(temp_ / "without/report.json"));
  EXPECT_THAT(told["turning"]["sentence"].get<std::string>(), HasSubstr("own features"));

  // Once more from the files alone: the same points.
  const auto again =
      test::gyre({"reconstruct", (temp_ / "with").string(), "--out", (temp_ / "again").string()});
  EXPECT_THAT(again.out, HasSubstr(std::to_string(with) + " points")) << again.err;
  EXPECT_EQ(fileText(temp_ / "again/angles_solved.csv"),
            fileText(temp_ / "with/angles_solved.csv"));
  // The results kept the whole record.
  EXPECT_EQ(readCalibrationRecord(temp_ / "with/calibration.json")->target, "ring");
}

TEST_F(RingScan, TellsAPushedTableAtTheEnd) {
  RigOptions options = ringRig();
  options.sim.push_mm = 1.0;
  options.sim.bump_at_deg = 200.0;
  static_cast<void>(scanInto(temp_ / "pushed", options, trueRecord(options.sim)));
  const auto report = nlohmann::json::parse(fileText(temp_ / "pushed/report.json"));
  // 15 deg a view: the first one beyond 200 deg is the fifteenth.
  EXPECT_THAT(report["drift"]["sentence"].get<std::string>(),
              HasSubstr("The turntable was pushed: from view 15 on"));
}

}  // namespace
}  // namespace gyre
