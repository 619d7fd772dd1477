// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/curve_underside.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stop_token>
#include <tuple>

#include <gtest/gtest.h>

#include "core/mesh/clean/crop.h"
#include "core/mesh/clean/rims.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/clean/underside.h"
#include "core/mesh/marching_tetrahedra.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 20.0;
constexpr double kLid_mm = 6.0;  // so high the ball is cut off
const Eigen::Vector3d kCentre(0.0, 0.0, kRadius_mm);

double outsideBall_mm(const Eigen::Vector3d& at) { return (at - kCentre).norm() - kRadius_mm; }

// The ball as a cut makes it whose cameras saw nothing below: a fan of wide triangles closes it.
Mesh ballOnALid() {
  Mesh whole = test::ballMesh(kRadius_mm, 96);
  for (MeshVertex& vertex : whole.vertices) vertex.position += kCentre;
  Mesh mesh = cropMesh(whole, {.z_min_mm = kLid_mm}, {})->mesh;
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.views = 7;
    vertex.sigma_mm = 0.02F;
    vertex.rgb = {static_cast<std::uint8_t>(40.0 + 4.0 * vertex.position.z()), 90, 30};
  }
  const Rim rim = findRims(mesh).front();
  const std::uint32_t middle = test::addVertex(mesh, {0.0, 0.0, kLid_mm});
  mesh.vertices[middle].seen = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    mesh.triangles.push_back({rim[i], rim[(i + 1) % rim.size()], middle});
  }
  computeNormals(mesh);
  if (meshHealth(mesh).volume_mm3 < 25000.0) ADD_FAILURE() << "the lid is inside out";
  return mesh;
}

// A ball that is cut off at its lid, on four legs that reach the table; seen but for the lid.
Mesh ballOnLegs() {
  const auto distance = [](const Eigen::Vector3d& at) {
    const Eigen::Vector2d leg(std::abs(at.x()) - 7.0, std::abs(at.y()) - 7.0);
    return std::min(std::max(outsideBall_mm(at), kLid_mm - at.z()),
                    std::max({leg.norm() - 2.0, -at.z(), at.z() - kRadius_mm}));
  };
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-21.0, -21.0, -1.0),
                                Eigen::Vector3d(21.0, 21.0, 41.0));
  Mesh mesh = marchingTetrahedra(sampleDistance(distance, box, 0.6));
  for (MeshVertex& vertex : mesh.vertices) {
    const bool is_lid = std::abs(vertex.position.z() - kLid_mm) < 0.05 && vertex.normal.z() < -0.9;
    vertex.seen = is_lid ? 0 : 1;
  }
  return mesh;
}

void expectSound(const Mesh& before, const Mesh& after) {
  EXPECT_EQ(meshHealth(after).closed, meshHealth(before).closed);
  EXPECT_EQ(meshHealth(after).genus, meshHealth(before).genus);
  EXPECT_EQ(meshHealth(after).components, meshHealth(before).components);
  EXPECT_EQ(*countSelfIntersections(after, {}), 0U);
}

// Every vertex that a camera saw is still there as it was.
void expectSeenKept(const Mesh& before, const Mesh& after) {
  const auto key = [](const MeshVertex& vertex) {
    return std::tuple(vertex.position.x(), vertex.position.y(), vertex.position.z(), vertex.rgb,
                      vertex.views, vertex.sigma_mm);
  };
  std::set<decltype(key(MeshVertex()))> seen;
  for (const MeshVertex& vertex : before.vertices) {
    if (vertex.seen != 0) seen.insert(key(vertex));
  }
  for (const MeshVertex& vertex : after.vertices) {
    if (vertex.seen != 0) seen.erase(key(vertex));
  }
  EXPECT_EQ(seen.size(), 0U);
}

TEST(CurveUnderside, FollowsABallBelowWhereCamerasSaw) {
  const Mesh body = ballOnALid();
  const auto curved = curveUnderside(body, {});
  ASSERT_TRUE(curved);
  EXPECT_GT(curved->vertices, 50U);
  expectSound(body, curved->mesh);
  expectSeenKept(body, curved->mesh);
  double farthest_mm = 0.0;
  for (const MeshVertex& vertex : curved->mesh.vertices) {
    if (vertex.seen != 0) continue;
    farthest_mm = std::max(farthest_mm, std::abs(outsideBall_mm(vertex.position)));
    EXPECT_GE(vertex.position.z(), 0.0);
    EXPECT_EQ(vertex.views, 0);
  }
  // The lid's middle was 6 mm inside the ball.
  EXPECT_LT(farthest_mm, 2.0);
  EXPECT_GT(curved->bent_mm, 3.5);
  const double whole_mm3 = 4.0 / 3.0 * kPi * std::pow(kRadius_mm, 3);
  EXPECT_LT(std::abs(meshHealth(curved->mesh).volume_mm3 - whole_mm3),
            0.5 * std::abs(meshHealth(body).volume_mm3 - whole_mm3));
}

TEST(CurveUnderside, MarksWhatItMadeAsUnseen) {
  const Mesh body = ballOnALid();
  const auto curved = curveUnderside(body, {});
  ASSERT_TRUE(curved);
  // A cap has more area than its lid: here, of 6 mm height, 18 % more.
  const double ratio = meshHealth(curved->mesh).unseen_area_mm2 / meshHealth(body).unseen_area_mm2;
  EXPECT_GT(ratio, 1.0);
  EXPECT_LT(ratio, 1.25);
}

TEST(CurveUnderside, GoesAroundLegs) {
  const Mesh table = ballOnLegs();
  const auto curved = curveUnderside(table, {});
  ASSERT_TRUE(curved);
  expectSound(table, curved->mesh);
  expectSeenKept(table, curved->mesh);
  EXPECT_GT(curved->vertices, 0U);
}

TEST(CurveUnderside, DoesNotBendThroughWhatLiesBelow) {
  Mesh body = ballOnALid();
  const Mesh slab = test::boxMesh({-30.0, -6.0, 3.5}, {30.0, 6.0, 4.0});
  const auto first = static_cast<std::uint32_t>(body.vertices.size());
  body.vertices.insert(body.vertices.end(), slab.vertices.begin(), slab.vertices.end());
  for (const auto& [a, b, c] : slab.triangles) {
    body.triangles.push_back({first + a, first + b, first + c});
  }
  const auto curved = curveUnderside(body, {});
  ASSERT_TRUE(curved);
  expectSound(body, curved->mesh);
  expectSeenKept(body, curved->mesh);
  EXPECT_GT(curved->vertices, 0U);
  for (const MeshVertex& vertex : curved->mesh.vertices) {
    const Eigen::Vector3d& at = vertex.position;
    EXPECT_TRUE(vertex.seen != 0 || std::abs(at.y()) > 5.0 || at.z() > 4.0) << at.transpose();
  }
}

TEST(CurveUnderside, LeavesABaseOnTheTableAndSmallGuessesAlone) {
  Mesh ball = test::ballMesh(kRadius_mm, 48);  // its vertex in the south lies lowest
  for (MeshVertex& vertex : ball.vertices) {
    vertex.position.z() = std::max(vertex.position.z(), -0.8 * kRadius_mm);
    if (vertex.position.z() <= -0.8 * kRadius_mm) vertex.seen = 0;
  }
  for (const double lift_mm : {0.8 * kRadius_mm, 0.0}) {
    Mesh resting = ball;
    for (MeshVertex& vertex : resting.vertices) vertex.position.z() += lift_mm;
    EXPECT_EQ(curveUnderside(resting, {})->vertices, 0U) << lift_mm;
  }
  Mesh speck = test::ballMesh(kRadius_mm, 96);
  for (MeshVertex& vertex : speck.vertices) vertex.position += kCentre;
  speck.vertices[0].seen = 0;
  EXPECT_TRUE(guessedUnderside(speck, 0.1).empty());
}

TEST(CurveUnderside, RefusesWhatIsNoSurfaceAndStops) {
  EXPECT_FALSE(curveUnderside(Mesh{}, {}));
  std::stop_source source;
  source.request_stop();
  const auto stopped = curveUnderside(ballOnALid(), Task(source.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
