// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/densify.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "core/base/median.h"
#include "core/base/units.h"
#include "core/pipeline/live_reconstruction.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

constexpr int kViews = 24;

struct Pictures {
  FramePtr bare_table;
  std::vector<FramePtr> views;
};

Pictures picturesOf(const test::TurningCylinder& world) {
  Pictures pictures{std::make_shared<const Frame>(world.renderEmpty()), {}};
  for (int view = 0; view < kViews; ++view) {
    pictures.views.push_back(std::make_shared<const Frame>(world.render(radFromDeg(3.0 * view))));
  }
  return pictures;
}

Reconstruction scanned(const Pictures& pictures, double spacing_px) {
  ReconstructOptions options;
  options.cloud.point_spacing_px = spacing_px;
  auto live = LiveReconstruction::create(test::TurningCylinder{}.calibration(), pictures.bare_table,
                                         options);
  for (const FramePtr& frame : pictures.views) EXPECT_TRUE(live->addFrame(frame));
  return live->finish({}).value();
}

const Pictures& cylinder() {
  static const Pictures kPictures = picturesOf({});
  return kPictures;
}

const Reconstruction& sparse() {
  static const Reconstruction kSparse = scanned(cylinder(), 0.0);
  return kSparse;
}

const Reconstruction& dense() {
  static const Reconstruction kDense = scanned(cylinder(), 3.0);
  return kDense;
}

double medianMiss(const PointCloud& cloud) {
  std::vector<double> misses_mm;
  for (const Point& point : cloud.points) {
    misses_mm.push_back(test::TurningCylinder{}.distanceToSurface(point.position));
  }
  return median(std::move(misses_mm));
}

// A pixel is 0.32 mm of the cylinder where it faces the camera.
std::size_t nearPairs(const PointCloud& cloud) {
  std::size_t near = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      near += (cloud.points[i].position - cloud.points[k].position).norm() < 0.6 ? 1U : 0U;
    }
  }
  return near;
}

double meanGrey(const PointCloud& cloud) {
  double sum = 0.0;
  for (const Point& point : cloud.points) sum += point.rgb[0] + point.rgb[1] + point.rgb[2];
  return sum / (3.0 * static_cast<double>(cloud.points.size()));
}

TEST(Densify, FillsTheSurfaceBetweenTheFeatures) {
  EXPECT_GT(dense().cloud.points.size(), 3 * sparse().cloud.points.size());
  // Features are where texture is best: what lies between is a little less certain.
  EXPECT_LT(medianMiss(dense().cloud), 1.4 * medianMiss(sparse().cloud));
  EXPECT_LT(dense().median_px, 1.2 * sparse().median_px);
  for (const Point& point : dense().cloud.points) {
    EXPECT_GE(point.views.size(), 3U);
    EXPECT_TRUE(std::is_sorted(point.views.begin(), point.views.end()));
    EXPECT_GT(point.sigmaMm(), 0.0);
    EXPECT_GT(point.normal.norm(), 0.99);
  }
}

TEST(Densify, KeepsGrownPointsApart) {
  EXPECT_LT(nearPairs(dense().cloud), nearPairs(sparse().cloud) + dense().cloud.points.size() / 50);
}

TEST(Densify, GivesGrownPointsTheColourOfTheirPlace) {
  EXPECT_NEAR(meanGrey(dense().cloud), meanGrey(sparse().cloud), 15.0);
}

TEST(Densify, GrowsNothingOnAPlainObject) {
  test::TurningCylinder plain;
  plain.contrast = 0.0;
  EXPECT_LT(scanned(picturesOf(plain), 3.0).cloud.points.size(), 20U);
}

TEST(Densify, GivesTheSamePointsOnOneThreadAsOnMany) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const PointCloud single = scanned(cylinder(), 3.0).cloud;
  ASSERT_EQ(dense().cloud.points.size(), single.points.size());
  for (std::size_t i = 0; i < single.points.size(); ++i) {
    EXPECT_EQ(dense().cloud.points[i].position, single.points[i].position);
    EXPECT_EQ(dense().cloud.points[i].rgb, single.points[i].rgb);
  }
}

}  // namespace
}  // namespace gyre
