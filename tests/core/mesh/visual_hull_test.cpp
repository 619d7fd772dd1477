// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/visual_hull.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/looking_cameras.h"

namespace gyre {
namespace {

constexpr double kMmAPixel = 400.0 / 600.0;

// Half the size of the other tests' one, so that drawing stays quick.
CameraModel smallCamera() {
  CameraModel camera = test::plainCamera();
  camera.width_px = 320;
  camera.height_px = 240;
  camera.fx = camera.fy = 600.0;
  camera.cx = 159.5;
  camera.cy = 119.5;
  return camera;
}

// Whether a line of sight meets the object.
using Hits = std::function<bool(const Ray&)>;

bool hitsBall(const Ray& ray, const Eigen::Vector3d& centre, double radius_mm) {
  const Eigen::Vector3d to = centre - ray.origin;
  return (to - to.dot(ray.direction) * ray.direction).norm() <= radius_mm;
}

// The mask of half the picture's size that a picture with exact pixels leaves.
SightEvidence outlinesOf(const Hits& hits, int views) {
  SightEvidence evidence;
  const CameraModel camera = smallCamera();
  for (const Rigid3& pose : test::turnOfViews(test::lookAt({0, 0, 20}, 400.0, 0.35), views)) {
    cv::Mat mask = cv::Mat::zeros(120, 160, CV_8U);
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const Eigen::Vector2d pixel(x, y);
        if (hits(rayThrough(pose, camera.normalizedFromPixel(pixel)))) {
          mask.at<std::uint8_t>(y / 2, x / 2) = 255;
        }
      }
    }
    evidence.outlines.push_back({{camera, pose}, mask});
  }
  return evidence;
}

SightEvidence ballOutlines(int views) {
  return outlinesOf([](const Ray& ray) { return hitsBall(ray, {5, 0, 20}, 20.0); }, views);
}

double medianDistance(const Mesh& mesh, const Eigen::Vector3d& centre, double radius_mm) {
  std::vector<double> distances;
  for (const MeshVertex& vertex : mesh.vertices) {
    distances.push_back((vertex.position - centre).norm() - radius_mm);
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

TEST(VisualHull, MakesABallWithinAFractionOfAPixel) {
  const auto hull = visualHull(ballOutlines(24), {}, {});
  ASSERT_TRUE(hull) << hull.error().sentence();
  const MeshHealth health = meshHealth(hull->mesh);
  EXPECT_EQ(health.genus, 0);
  EXPECT_EQ(health.components, 1U);
  // Around the equator, where outlines touch it: neither shrunk nor grown by half a pixel.
  Mesh belt;
  for (const MeshVertex& vertex : hull->mesh.vertices) {
    if (std::abs(vertex.position.z() - 25.0) < 6.0) belt.vertices.push_back(vertex);
  }
  EXPECT_NEAR(medianDistance(belt, {5, 0, 20}, 20.0), 0.0, 0.35 * kMmAPixel);
  // Everything solid is inside what every outline leaves, and nothing of the ball is cut off.
  for (const MeshVertex& vertex : hull->mesh.vertices) {
    EXPECT_GT((vertex.position - Eigen::Vector3d(5, 0, 20)).norm(), 20.0 - 1.2 * kMmAPixel);
    EXPECT_GE(vertex.position.z(), 0.0);
  }
}

TEST(VisualHull, KeepsAHoleThatOutlinesShow) {
  // A ring that stands upright, of balls.
  const auto ring = [](const Ray& ray) {
    for (int i = 0; i < 24; ++i) {
      const double turn_rad = kTurn_rad * i / 24;
      const Eigen::Vector3d centre(0, 16.0 * std::cos(turn_rad), 22.0 + 16.0 * std::sin(turn_rad));
      if (hitsBall(ray, centre, 5.0)) return true;
    }
    return false;
  };
  const auto hull = visualHull(outlinesOf(ring, 16), {}, {});
  ASSERT_TRUE(hull) << hull.error().sentence();
  EXPECT_EQ(meshHealth(hull->mesh).genus, 1);
}

TEST(VisualHull, ForgivesAFewWrongOutlines) {
  SightEvidence evidence = ballOutlines(24);
  evidence.outlines[4].mask(cv::Rect(0, 0, 160, 59)).setTo(0);
  const auto cut = visualHull(evidence, {.disbelieved_share = 0.0}, {});
  const auto whole = visualHull(evidence, {.disbelieved_share = 0.06}, {});
  ASSERT_TRUE(cut);
  ASSERT_TRUE(whole);
  const double ball_mm3 = 4.0 / 3.0 * kPi * 8000.0;
  EXPECT_LT(meshHealth(cut->mesh).volume_mm3, 0.9 * ball_mm3);
  EXPECT_GT(meshHealth(whole->mesh).volume_mm3, 0.98 * ball_mm3);
}

TEST(VisualHull, IsTheSameForAnyRunAndAsFineAsAsked) {
  const SightEvidence evidence = ballOutlines(12);
  const auto first = visualHull(evidence, {.cell_mm = 1.5}, {});
  const auto second = visualHull(evidence, {.cell_mm = 1.5}, {});
  const auto fine = visualHull(evidence, {.cell_mm = 0.75}, {});
  ASSERT_TRUE(first && second && fine);
  EXPECT_EQ(first->mesh.triangles, second->mesh.triangles);
  const auto ratio = static_cast<double>(fine->mesh.triangles.size()) /
                     static_cast<double>(first->mesh.triangles.size());
  EXPECT_NEAR(ratio, 4.0, 0.6);
}

TEST(VisualHull, SaysWhenOutlinesAreMissingOrContradictEachOther) {
  SightEvidence evidence = ballOutlines(4);
  evidence.outlines.resize(2);
  EXPECT_FALSE(visualHull(evidence, {}, {}));
  evidence = ballOutlines(8);
  for (std::size_t i = 0; i < evidence.outlines.size(); i += 2) evidence.outlines[i].mask.setTo(0);
  const auto nothing = visualHull(evidence, {}, {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Error::Code::kTooFew);
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = visualHull(ballOutlines(4), {}, Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
