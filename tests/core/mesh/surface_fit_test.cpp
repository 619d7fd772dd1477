// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "tests/support/solids.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 30.0;
constexpr std::size_t kLongitudes = 240;

// One half of an egg with a bump, and a little more, as a scan of it would see: the other half's
// vertices are there, but nobody saw them.
struct Half {
  Mesh mesh;
  PointCloud cloud;
};

// Where a ball's place goes on a body without any symmetry.
Eigen::Vector3d shaped(const Eigen::Vector3d& on_ball) {
  const Eigen::Vector3d way = on_ball.normalized();
  const double bump = 5.0 * std::exp(-8.0 * (way - Eigen::Vector3d(0.8, 0.6, 0.0)).squaredNorm());
  const double wave = 1.5 * std::sin(3.0 * way.x() + 1.0) * std::cos(4.0 * way.y());
  return (kRadius_mm + bump + wave) * Eigen::Vector3d(way.x(), 0.8 * way.y(), 1.2 * way.z());
}

// seen_from: a vertex is seen when it lies that way by more than `least` of the radius.
Half halfOf(const Eigen::Vector3d& seen_from, double least, const Rigid3& here_from_body,
            double noise_mm, bool round = false) {
  Half half;
  half.mesh = test::ballMesh(kRadius_mm, kLongitudes);
  std::vector<double> towards;
  // Vertices of two scans are never the same places: where they are, noise prefers to lie between.
  const Eigen::Matrix3d grid =
      Eigen::AngleAxisd(0.5 * seen_from.z(), Eigen::Vector3d(1, 2, -1).normalized())
          .toRotationMatrix();
  for (MeshVertex& vertex : half.mesh.vertices) {
    vertex.position = grid * vertex.position;
    towards.push_back(seen_from.dot(vertex.position.normalized()));
    if (!round) vertex.position = shaped(vertex.position);
    vertex.position = here_from_body * vertex.position;
  }
  computeNormals(half.mesh);
  Random random(17 + static_cast<std::uint64_t>(1000.0 * (1.0 + seen_from.z())));
  for (std::size_t i = 0; i < half.mesh.vertices.size(); ++i) {
    MeshVertex& vertex = half.mesh.vertices[i];
    vertex.seen = towards[i] > least ? 1 : 0;
    vertex.position += noise_mm * random.gaussian() * vertex.normal;
    if (vertex.seen == 0) continue;
    Point point;
    point.position = vertex.position;
    point.normal = vertex.normal;
    half.cloud.points.push_back(point);
  }
  return half;
}

Rigid3 turnedOver() {
  Rigid3 motion;
  motion.rotation =
      Eigen::AngleAxisd(2.9, Eigen::Vector3d(3, 1, -1).normalized()).toRotationMatrix();
  motion.translation = {4.0, -7.0, 61.0};
  return motion;
}

// The truth, a little off, as matched spots would have it.
Rigid3 nearTruth(double off_mm) {
  Rigid3 off;
  off.rotation = Eigen::AngleAxisd(off_mm / kRadius_mm, Eigen::Vector3d(1, -2, 1).normalized())
                     .toRotationMatrix();
  off.translation = Eigen::Vector3d(off_mm, 0.5 * off_mm, -off_mm);
  return off * turnedOver().inverse();
}

// How far the motion takes the body's surface wrong, at the most.
double largestMiss(const Rigid3& fixed_from_moving) {
  double miss_mm = 0.0;
  for (const MeshVertex& vertex : test::ballMesh(kRadius_mm, 24).vertices) {
    const Eigen::Vector3d place = shaped(vertex.position);
    miss_mm = std::max(miss_mm, (fixed_from_moving * (turnedOver() * place) - place).norm());
  }
  return miss_mm;
}

TEST(FitSurfaces, BringsTwoHalvesTogether) {
  const Half top = halfOf(Eigen::Vector3d::UnitZ(), -0.4, {}, 0.0);
  const Half bottom = halfOf(-Eigen::Vector3d::UnitZ(), -0.4, turnedOver(), 0.0);
  const auto fit =
      fitSurfaces({top.mesh, top.cloud}, {bottom.mesh, bottom.cloud}, {}, nearTruth(0.8), {});
  ASSERT_TRUE(fit) << fit.error().what;
  EXPECT_LT(largestMiss(fit->fixed_from_moving), 0.01);
  EXPECT_LT(fit->residual_mm, 0.004);  // chords of a ball are not the ball
  // Of a cap of 1.4 radii a belt of 0.8 is shared; its points are not spread evenly.
  EXPECT_NEAR(fit->overlap, 0.8 / 1.4, 0.16);
}

TEST(FitSurfaces, DoesSoWithNoise) {
  constexpr double kNoise_mm = 0.05;
  const Half top = halfOf(Eigen::Vector3d::UnitZ(), -0.4, {}, kNoise_mm);
  const Half bottom = halfOf(-Eigen::Vector3d::UnitZ(), -0.4, turnedOver(), kNoise_mm);
  const auto fit =
      fitSurfaces({top.mesh, top.cloud}, {bottom.mesh, bottom.cloud}, {}, nearTruth(0.8), {});
  ASSERT_TRUE(fit) << fit.error().what;
  // Thousands of points hold six unknowns better than each of them is known.
  EXPECT_LT(largestMiss(fit->fixed_from_moving), 0.5 * kNoise_mm);
  EXPECT_GT(fit->residual_mm, 0.01);
  EXPECT_LT(fit->residual_mm, 0.08);
}

TEST(FitSurfaces, IsNotMisledByWhatNobodySaw) {
  Half top = halfOf(Eigen::Vector3d::UnitZ(), -0.4, {}, 0.0);
  for (MeshVertex& vertex : top.mesh.vertices) {  // a guessed base, 2 mm too far in
    if (vertex.seen == 0) vertex.position *= 0.93;
  }
  const Half bottom = halfOf(-Eigen::Vector3d::UnitZ(), -0.4, turnedOver(), 0.0);
  const auto fit =
      fitSurfaces({top.mesh, top.cloud}, {bottom.mesh, bottom.cloud}, {}, nearTruth(0.8), {});
  ASSERT_TRUE(fit) << fit.error().what;
  EXPECT_LT(largestMiss(fit->fixed_from_moving), 0.01);
}

// A ball turns freely in itself: only the spots know how far.
TEST(FitSurfaces, HoldsByPairsWhatSlidesFreely) {
  const Half top = halfOf(Eigen::Vector3d::UnitZ(), -0.4, {}, 0.0, true);
  const Half bottom = halfOf(-Eigen::Vector3d::UnitZ(), -0.4, turnedOver(), 0.0, true);
  std::vector<PlacePair> pairs;
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double turn_rad = random.uniform(0.0, 6.28);
    const Eigen::Vector3d place =
        kRadius_mm *
        Eigen::Vector3d(std::cos(turn_rad), std::sin(turn_rad), random.uniform(-0.3, 0.3))
            .normalized();
    const Eigen::Vector3d noise(random.gaussian(), random.gaussian(), random.gaussian());
    pairs.push_back({place + 0.1 * noise, turnedOver() * place});
  }
  const auto fit =
      fitSurfaces({top.mesh, top.cloud}, {bottom.mesh, bottom.cloud}, pairs, nearTruth(0.8), {});
  ASSERT_TRUE(fit) << fit.error().what;
  const Rigid3 miss = fit->fixed_from_moving * turnedOver();
  // 200 spots of 0.1 mm: 0.1 mm / sqrt(200) / 30 mm in each angle, times three.
  EXPECT_LT(Eigen::AngleAxisd(miss.rotation).angle(), 0.0015);
  EXPECT_LT(miss.translation.norm(), 0.03);
}

TEST(FitSurfaces, RefusesWhatHardlyOverlaps) {
  const Half top = halfOf(Eigen::Vector3d::UnitZ(), 0.5, {}, 0.0);
  const Half bottom = halfOf(-Eigen::Vector3d::UnitZ(), 0.5, turnedOver(), 0.0);
  const auto fit =
      fitSurfaces({top.mesh, top.cloud}, {bottom.mesh, bottom.cloud}, {}, nearTruth(0.0), {});
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, Error::Code::kTooFew);
  EXPECT_FALSE(fitSurfaces({top.mesh, top.cloud}, {{}, {}}, {}, {}, {}));
}

TEST(FitSurfaces, HearsTheStop) {
  const Half top = halfOf(Eigen::Vector3d::UnitZ(), -0.4, {}, 0.0);
  std::stop_source stop;
  stop.request_stop();
  const auto fit =
      fitSurfaces({top.mesh, top.cloud}, {top.mesh, top.cloud}, {}, {}, Task(stop.get_token()));
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
