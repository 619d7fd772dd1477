// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/cube_experiment.h"

#include <stop_token>

#include <gtest/gtest.h>

namespace gyre {
namespace {

CubeExperimentOptions small() {
  CubeExperimentOptions options;
  options.runs = 1;
  options.views = {20};
  options.image_width_px = 640;
  return options;
}

TEST(CubeExperiment, FindsCalibrationTheLargerShareAsThePaperDid) {
  const auto table = cubeExperiment(small(), {});
  ASSERT_TRUE(table) << table.error().sentence();
  ASSERT_EQ(table->rows.size(), 2U);  // the run and the mean
  EXPECT_EQ(table->rows[0][0], 1.0);
  EXPECT_FALSE(table->rows[1][0]);
  const auto cell = [&](const std::string& key) {
    for (std::size_t i = 0; i < table->columns.size(); ++i) {
      if (table->columns[i].key == key) return table->rows[0][i].value();
    }
    ADD_FAILURE() << "no column " << key;
    return 0.0;
  };
  // Half a millimetre of placement comes back in the corners; a whole turn has no such error.
  EXPECT_GT(cell("by_hand_error_mm"), 0.3);
  EXPECT_LT(cell("whole_turn_error_mm"), 0.2);
  EXPECT_LT(cell("whole_turn_calibration_mm"), cell("one_picture_calibration_mm"));
  EXPECT_EQ(cell("by_hand_error_percent"), cell("by_hand_error_mm"));
}

TEST(CubeExperiment, RefusesNothingToDoAndStops) {
  CubeExperimentOptions none = small();
  none.runs = 0;
  EXPECT_FALSE(cubeExperiment(none, {}));
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = cubeExperiment(small(), Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
