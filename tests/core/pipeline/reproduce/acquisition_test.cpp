// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/acquisition.h"

#include <stop_token>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace gyre {
namespace {

TEST(Acquisition, ScansMeasuresAndDrawsAnObject) {
  AcquisitionOptions options;
  options.objects = {"duck"};
  options.views = 60;
  options.image_width_px = 640;
  const auto acquired = acquisitionExperiment(options, {});
  ASSERT_TRUE(acquired) << acquired.error().sentence();
  ASSERT_EQ(acquired->table.rows.size(), 1U);
  const auto& row = acquired->table.rows.front();
  ASSERT_EQ(row.size(), acquired->table.columns.size());
  EXPECT_GT(*row[1], 1500.0);  // points
  EXPECT_LT(*row[2], 0.05);    // their median distance, % of the size
  EXPECT_LT(*row[4], 0.1);     // and the mesh's
  EXPECT_GT(*row[6], 85.0);    // completeness

  ASSERT_EQ(acquired->figures.size(), 1U);
  EXPECT_EQ(acquired->figures[0].name, "figure-duck");
  const cv::Mat& figure = acquired->figures[0].picture_bgr;
  EXPECT_EQ(figure.size(), cv::Size(1920, 1440));
  // Points and surface are drawn on white, and much of it is neither white nor empty.
  for (int row_of_figure = 1; row_of_figure < 3; ++row_of_figure) {
    const cv::Mat middle = figure({220, 480 * row_of_figure + 140, 200, 200});
    EXPECT_LT(cv::mean(middle)[0], 240.0) << row_of_figure;
    EXPECT_EQ(figure.at<cv::Vec3b>(480 * row_of_figure + 5, 5), cv::Vec3b(255, 255, 255));
  }
}

TEST(Acquisition, RefusesNothingToScanAndObjectsThatAreUnknown) {
  AcquisitionOptions options;
  options.objects.clear();
  EXPECT_FALSE(acquisitionExperiment(options, {}));
  options.objects = {"unicorn"};
  EXPECT_FALSE(acquisitionExperiment(options, {}));
  options = {};
  options.views = 2;
  EXPECT_FALSE(acquisitionExperiment(options, {}));
}

TEST(Acquisition, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const auto acquired = acquisitionExperiment({}, Task(stop.get_token()));
  ASSERT_FALSE(acquired);
  EXPECT_EQ(acquired.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
