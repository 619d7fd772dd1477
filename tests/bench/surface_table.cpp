// Prints how the surfaces of known bodies come out, by method and noise: docs/algorithms.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/median.h"
#include "core/mesh/alpha_filtration.h"
#include "core/mesh/components.h"
#include "core/mesh/mesh_health.h"
#include "core/mesh/surface_points.h"
#include "core/pipeline/make_mesh.h"
#include "tests/support/seen_bodies.h"

namespace gyre {
namespace {

void print(const test::Body& body, double noise_share, const char* method, const Mesh& mesh) {
  const MeshHealth health = meshHealth(mesh);
  std::printf("| %s | %.0f %% | %s | %zu | %zu | %zu | %ld (%d) | %.2f | %.2f |\n",
              body.name.c_str(), 100.0 * noise_share, method, health.components,
              health.boundary_edges, health.non_manifold_edges,
              static_cast<long>(health.euler_number), body.euler_number,
              test::errorInSpacings(mesh, body, 0.5), test::errorInSpacings(mesh, body, 0.95));
}

// What the paper does: the outer facets of the points as they are, alpha of two median spacings.
void printPlain(const test::Body& body, double noise_share) {
  const auto seen = test::seenBody(body, noise_share, 1);
  std::vector<double> spacing_mm;
  Mesh mesh;
  for (const Point& point : seen.cloud.points) {
    spacing_mm.push_back(body.spacing_mm(point.position));
    mesh.vertices.push_back(vertexOf(point));
  }
  const AlphaFiltration filtration(*delaunay(positionsOf(seen.cloud), {}));
  for (const AlphaFacet& facet : filtration.outerBoundary(2.0 * median(spacing_mm))) {
    mesh.triangles.push_back(facet.corners);
  }
  removeUnusedVertices(mesh);
  print(body, noise_share, "plain alpha", mesh);
}

void printRow(const test::Body& body, double noise_share, MeshMethod method) {
  const auto seen = test::seenBody(body, noise_share, 1);
  MeshRequest request;
  request.method = method;
  const auto made = makeMesh(seen.cloud, seen.sights, request, {});
  if (!made) {
    std::printf("| %s | %.0f %% | %s | %s |\n", body.name.c_str(), 100.0 * noise_share,
                std::string(wordOf(method)).c_str(), made.error().what.c_str());
    return;
  }
  print(body, noise_share, std::string(wordOf(method)).c_str(), made->mesh);
}

}  // namespace
}  // namespace gyre

int main() {
  using namespace gyre;
  std::printf(
      "| body | noise | method | pieces | open edges | non-manifold edges | Euler (true) | median "
      "| 95 "
      "%% |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& body : {test::sphereBody(), test::torusBody(), test::plateBody(),
                           test::cubeBody(), test::tenfoldBody()}) {
    for (const double noise_share : {0.0, 0.05, 0.1, 0.3}) {
      printPlain(body, noise_share);
      for (const auto& [method, word] : kMeshMethodWords) {
        if (method != MeshMethod::kAuto) printRow(body, noise_share, method);
      }
    }
  }
  return 0;
}
