// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_facets.h"

#include <gtest/gtest.h>
#include <array>

#include <Eigen/Geometry>

#include "core/mesh/mesh_health.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

// For one radius.
Result<std::vector<AlphaFacet>> facetsOf(const std::vector<Eigen::Vector3d>& points,
                                         double alpha_mm) {
  const auto facets = outerAlphaFacets(points, std::array{alpha_mm});
  if (!facets) return facets.error();
  return facets->at(0);
}

std::vector<Eigen::Vector3d> positionsOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return positions;
}

TEST(OuterAlphaFacets, OfATetrahedronLookOutward) {
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const auto facets = facetsOf(corners, 10.0);
  ASSERT_TRUE(facets);
  ASSERT_EQ(facets->size(), 4U);
  for (const AlphaFacet& facet : *facets) {
    const auto [a, b, c] = facet.corners;
    const Eigen::Vector3d normal =
        (corners[b] - corners[a]).cross(corners[c] - corners[a]).normalized();
    EXPECT_GT(normal.dot(corners[a] - Eigen::Vector3d(0.4, 0.4, 0.4)), 0.0);
    EXPECT_FALSE(facet.both_sides);
  }
}

TEST(OuterAlphaFacets, AreTwoSidedWhereTheBallFitsInside) {
  // The faces' circles have radii 1.414 and 1.633, the ball through all four 1.732.
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const auto sheet = facetsOf(corners, 1.65);
  ASSERT_TRUE(sheet);
  for (const AlphaFacet& facet : *sheet) EXPECT_LE(facet.radius_mm, 1.65);
  EXPECT_TRUE(facetsOf(corners, 0.5)->empty());
}

TEST(OuterAlphaFacets, OfAnEvenSphereAreAClosedManifold) {
  const auto points = positionsOf(test::sphereCloud(2000, 10.0));
  const double spacing_mm = std::sqrt(4.0 * kPi * 100.0 / 2000.0);
  const auto facets = facetsOf(points, 1.5 * spacing_mm);
  ASSERT_TRUE(facets);
  EXPECT_EQ(facets->size(), 3996U);  // 2 n - 4: Euler's number of a sphere
}

TEST(OuterAlphaFacets, LeaveOutAHollowThatTheBallCannotEnter) {
  auto points = positionsOf(test::sphereCloud(2000, 10.0));
  const auto inner = positionsOf(test::sphereCloud(500, 5.0));
  points.insert(points.end(), inner.begin(), inner.end());
  const auto facets = facetsOf(points, 0.9);
  ASSERT_TRUE(facets);
  for (const AlphaFacet& facet : *facets) EXPECT_LT(facet.corners[0], 2000U);
}

TEST(OuterAlphaFacets, OfSeveralRadiiAreThoseOfEach) {
  const auto points = positionsOf(test::torusCloud(1500, 20.0, 8.0));
  const auto both = outerAlphaFacets(points, std::array{4.0, 2.0});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->at(0).size(), facetsOf(points, 4.0)->size());
  EXPECT_EQ(both->at(1).size(), facetsOf(points, 2.0)->size());
  EXPECT_NE(both->at(0).size(), both->at(1).size());
}

TEST(OuterAlphaFacets, SayWhenThePointsAreTooFewOrFlat) {
  std::vector<Eigen::Vector3d> flat;
  for (int i = 0; i < 9; ++i) flat.emplace_back(i % 3, i / 3, 1.0);
  EXPECT_EQ(facetsOf(flat, 5.0).error().code, Error::Code::kTooFew);
  EXPECT_EQ(facetsOf({}, 5.0).error().code, Error::Code::kTooFew);
  EXPECT_EQ(facetsOf({{1, 1, 1}}, 5.0).error().code, Error::Code::kTooFew);
}

}  // namespace
}  // namespace gyre
