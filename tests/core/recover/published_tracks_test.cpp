// Finds points from the tracks of the Oxford dinosaur, as they are published: real, and some wrong.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_file.h"
#include "core/recover/point_estimator.h"
#include "core/scan/track.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

struct PublishedTurn {
  CameraModel camera;
  std::vector<Rigid3> cam_from_table;
  std::vector<std::vector<Observation>> tracks;
};

PublishedTurn readTurn(const fs::path& folder) {
  PublishedTurn turn;
  const Calibration calibration = readCalibration(folder / "calibration.json").value();
  turn.camera = calibration.camera;
  const AngleTable angles = readAngles(folder / "angles.csv").value();  // in the pictures' order
  for (const auto& [name, angle_rad] : angles) {
    turn.cam_from_table.push_back(camFromTable(*calibration.cam_from_table, angle_rad));
  }
  std::ifstream file(folder / "tracks.csv");
  std::string line;
  std::getline(file, line);  // track,view,x_px,y_px
  while (std::getline(file, line)) {
    std::size_t track = 0;
    Observation seen;
    double x_px = 0.0;
    double y_px = 0.0;
    const int read = std::sscanf(line.c_str(), "%zu,%d,%lf,%lf", &track, &seen.view, &x_px, &y_px);
    if (read != 4) continue;
    seen.pixel = {x_px, y_px};
    turn.tracks.resize(std::max(turn.tracks.size(), track + 1));
    turn.tracks[track].push_back(seen);
  }
  return turn;
}

TEST(PublishedTracks, RobustPointsKeepNearlyAllSightingsWithinAThirdOfAPixel) {
  const char* root = std::getenv("GYRE_TEST_DATA");
  if (root == nullptr) GTEST_SKIP() << "GYRE_TEST_DATA is not set";
  const PublishedTurn turn = readTurn(fs::path(root) / "oxford_dino");
  ASSERT_EQ(turn.cam_from_table.size(), 36U);
  ASSERT_EQ(turn.tracks.size(), 4983U);
  RecoverOptions options;
  options.min_views = 2;
  options.min_agreeing = 0.5;
  // As far as these tracks scatter.
  const double sigma_px = 0.3;
  const double sigma = sigma_px / std::sqrt(turn.camera.fx * turn.camera.fy);
  PointEstimator estimator = PointEstimator::create(options).value();
  for (const Rigid3& pose : turn.cam_from_table) estimator.addPose(pose, 0.0);
  std::size_t all = 0;
  std::size_t kept = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < turn.tracks.size(); ++i) {
    std::vector<Sighting> sightings;
    for (const Observation& seen : turn.tracks[i]) {
      sightings.push_back({seen.view, turn.camera.normalizedFromPixel(seen.pixel), sigma});
    }
    all += sightings.size();
    const auto point = estimator.estimate(sightings, i);
    if (!point) continue;
    for (std::size_t k = 0; k < sightings.size(); ++k) {
      if (point->agrees[k] == 0) continue;
      const Observation& seen = turn.tracks[i][k];
      const auto pixel = turn.camera.project(
          turn.cam_from_table[static_cast<std::size_t>(seen.view)] * point->position_in_table);
      ASSERT_TRUE(pixel);
      squares += (*pixel - seen.pixel).squaredNorm();
      ++kept;
    }
  }
  const double share = static_cast<double>(kept) / static_cast<double>(all);
  const double rms_px = std::sqrt(squares / static_cast<double>(kept));
  RecordProperty("kept_percent", std::to_string(100.0 * share));
  RecordProperty("rms_px", std::to_string(rms_px));
  EXPECT_GE(share, 0.95);
  EXPECT_LE(rms_px, 0.30);
}

}  // namespace
}  // namespace gyre
