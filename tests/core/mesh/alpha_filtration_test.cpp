// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_filtration.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include <CGAL/Alpha_shape_3.h>
#include <CGAL/Alpha_shape_cell_base_3.h>
#include <CGAL/Alpha_shape_vertex_base_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/mesh/mesh_health.h"
#include "core/mesh/surface_points.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

Result<AlphaFiltration> filtrationOf(const std::vector<Eigen::Vector3d>& points) {
  auto tetrahedra = delaunay(points, {});
  if (!tetrahedra) return tetrahedra.error();
  return AlphaFiltration(std::move(*tetrahedra));
}

Result<std::vector<AlphaFacet>> facetsOf(const std::vector<Eigen::Vector3d>& points,
                                         double alpha_mm) {
  const auto filtration = filtrationOf(points);
  if (!filtration) return filtration.error();
  return filtration->outerBoundary(alpha_mm);
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using AlphaVertex = CGAL::Alpha_shape_vertex_base_3<
    Kernel, CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>>;
using AlphaTriangulation = CGAL::Delaunay_triangulation_3<
    Kernel,
    CGAL::Triangulation_data_structure_3<AlphaVertex, CGAL::Alpha_shape_cell_base_3<Kernel>>>;
using ReferenceShape = CGAL::Alpha_shape_3<AlphaTriangulation>;

using Corners = std::set<std::array<std::uint32_t, 3>>;

// What an independent program says the boundary is.
Corners boundaryByCgal(const ReferenceShape& shape) {
  Corners found;
  std::vector<ReferenceShape::Facet> facets;
  shape.get_alpha_shape_facets(std::back_inserter(facets), ReferenceShape::REGULAR);
  shape.get_alpha_shape_facets(std::back_inserter(facets), ReferenceShape::SINGULAR);
  for (const auto& [cell, side] : facets) {
    std::array<std::uint32_t, 3> corners{};
    for (int i = 1; i < 4; ++i) {
      corners[static_cast<std::size_t>(i) - 1] = cell->vertex((side + i) % 4)->info();
    }
    std::sort(corners.begin(), corners.end());
    found.insert(corners);
  }
  return found;
}

TEST(AlphaFiltration, HasTheFacetsOfCgalsAlphaShapeAtEveryAlpha) {
  PointCloud cloud = test::torusCloud(400, 20.0, 8.0);
  test::addNoise(cloud, 0.3, 5);
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
  for (const Eigen::Vector3d& point : positionsOf(cloud)) {
    numbered.emplace_back(Kernel::Point_3(point.x(), point.y(), point.z()),
                          static_cast<std::uint32_t>(numbered.size()));
  }
  AlphaTriangulation triangulation(numbered.begin(), numbered.end());
  ReferenceShape reference(triangulation, 0.0, ReferenceShape::GENERAL);
  const auto filtration = filtrationOf(positionsOf(cloud));
  ASSERT_TRUE(filtration);
  const std::vector<double> alphas_mm = filtration->alphasMm();
  ASSERT_GT(alphas_mm.size(), 2000U);
  for (std::size_t i = 0; i + 1 < alphas_mm.size(); i += 37) {
    const double alpha_mm = (alphas_mm[i] + alphas_mm[i + 1]) / 2.0;
    reference.set_alpha(alpha_mm * alpha_mm);
    Corners found;
    for (const AlphaFacet& facet : filtration->boundary(alpha_mm)) {
      std::array<std::uint32_t, 3> corners = facet.corners;
      std::sort(corners.begin(), corners.end());
      found.insert(corners);
    }
    ASSERT_EQ(found, boundaryByCgal(reference)) << "alpha " << alpha_mm;
  }
}

TEST(AlphaFiltration, KeepsTheBoundaryBetweenTwoOfItsAlphas) {
  const auto filtration = filtrationOf(positionsOf(test::torusCloud(300, 20.0, 8.0)));
  const std::vector<double> alphas_mm = filtration->alphasMm();
  const std::size_t i = alphas_mm.size() / 2;
  const double gap_mm = alphas_mm[i + 1] - alphas_mm[i];
  const auto low = filtration->boundary(alphas_mm[i] + 0.1 * gap_mm);
  const auto high = filtration->boundary(alphas_mm[i] + 0.9 * gap_mm);
  const auto next = filtration->boundary(alphas_mm[i + 1] + 1e-9);
  const auto cornersOf = [](const std::vector<AlphaFacet>& facets) {
    std::vector<Triangle> corners;
    for (const AlphaFacet& facet : facets) corners.push_back(facet.corners);
    return corners;
  };
  EXPECT_EQ(cornersOf(low), cornersOf(high));
  EXPECT_NE(cornersOf(low), cornersOf(next));
}

TEST(AlphaFiltration, OfATetrahedronLookOutward) {
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

TEST(AlphaFiltration, AreTwoSidedWhereTheBallFitsInside) {
  // The faces' circles have radii 1.414 and 1.633, the ball through all four 1.732.
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const auto sheet = facetsOf(corners, 1.65);
  ASSERT_TRUE(sheet);
  for (const AlphaFacet& facet : *sheet) EXPECT_LE(facet.radius_mm, 1.65);
  EXPECT_TRUE(facetsOf(corners, 0.5)->empty());
}

TEST(AlphaFiltration, OfAnEvenSphereAreAClosedManifold) {
  const auto points = positionsOf(test::sphereCloud(2000, 10.0));
  const double spacing_mm = std::sqrt(4.0 * kPi * 100.0 / 2000.0);
  const auto facets = facetsOf(points, 1.5 * spacing_mm);
  ASSERT_TRUE(facets);
  EXPECT_EQ(facets->size(), 3996U);  // 2 n - 4: Euler's number of a sphere
}

TEST(AlphaFiltration, LeaveOutAHollowThatTheBallCannotEnter) {
  auto points = positionsOf(test::sphereCloud(2000, 10.0));
  const auto inner = positionsOf(test::sphereCloud(500, 5.0));
  points.insert(points.end(), inner.begin(), inner.end());
  const auto facets = facetsOf(points, 0.9);
  ASSERT_TRUE(facets);
  for (const AlphaFacet& facet : *facets) EXPECT_LT(facet.corners[0], 2000U);
}

TEST(AlphaFiltration, SayWhenThePointsAreTooFewOrFlat) {
  std::vector<Eigen::Vector3d> flat;
  for (int i = 0; i < 9; ++i) flat.emplace_back(i % 3, i / 3, 1.0);
  EXPECT_EQ(facetsOf(flat, 5.0).error().code, Error::Code::kTooFew);
  EXPECT_EQ(facetsOf({}, 5.0).error().code, Error::Code::kTooFew);
  EXPECT_EQ(facetsOf({{1, 1, 1}}, 5.0).error().code, Error::Code::kTooFew);
}

}  // namespace
}  // namespace gyre
