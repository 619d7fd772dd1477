// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/outward_facets.h"

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh/manifold_selection.h"

namespace gyre {
namespace {

// Of alpha; the largest leaves to the others only the gaps of sparse regions.
constexpr std::array<double, 3> kAlphaLadder = {0.35, 0.6, 1.0};
// Cosine between a facet and the normals of its corners, below which it is a wall across a gap or
// the side of a sliver.
constexpr double kMinAgreement = 0.2;

double agreement(const Triangle& triangle, std::span<const MeshVertex> vertices) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d ab = vertices[b].position - vertices[a].position;
  const Eigen::Vector3d ac = vertices[c].position - vertices[a].position;
  const Eigen::Vector3d normals = vertices[a].normal + vertices[b].normal + vertices[c].normal;
  return ab.cross(ac).stableNormalized().dot(normals) / 3.0;
}

}  // namespace

std::vector<Triangle> outwardFacets(const AlphaFiltration& filtration, double alpha,
                                    std::span<const MeshVertex> vertices,
                                    const std::function<bool(const AlphaFacet&)>& allows) {
  std::vector<TriangleCandidate> candidates;
  // A facet of a smaller ball is one of the larger balls, too: it is asked once.
  std::vector<std::array<char, 4>> taken(filtration.tetrahedra().cells());
  int level = 0;
  for (const double step : kAlphaLadder) {
    for (const AlphaFacet& facet : filtration.outerBoundary(step * alpha)) {
      if (taken[facet.cell][facet.side] != 0) continue;
      const double agrees = agreement(facet.corners, vertices);
      const bool front = agrees > kMinAgreement;
      const bool back = facet.both_sides && agrees < -kMinAgreement;
      if ((!front && !back) || !allows(facet)) continue;
      taken[facet.cell][facet.side] = 1;
      const auto& [a, b, c] = facet.corners;
      candidates.push_back({front ? facet.corners : Triangle{a, c, b}, level, facet.radius_mm});
    }
    ++level;
  }
  return selectManifold(std::move(candidates));
}

}  // namespace gyre
