// Prints how the surfaces of known bodies come out, by method and noise: docs/algorithms.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <optional>
#include <string_view>

#include "core/mesh/mesh_health.h"
#include "core/pipeline/make_mesh.h"
#include "tests/support/seen_bodies.h"

namespace gyre {
namespace {

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
  const MeshHealth health = meshHealth(made->mesh);
  const long euler = static_cast<long>(health.vertices) -
                     static_cast<long>(3 * health.triangles + health.boundary_edges) / 2 +
                     static_cast<long>(health.triangles);
  std::printf("| %s | %.0f %% | %s | %zu | %zu | %zu | %zu | %ld (%d) | %.2f | %.2f |\n",
              body.name.c_str(), 100.0 * noise_share, std::string(wordOf(method)).c_str(),
              seen.cloud.points.size(), health.components, health.boundary_edges,
              health.non_manifold_edges, euler, body.euler_number,
              test::errorInSpacings(made->mesh, body, 0.5),
              test::errorInSpacings(made->mesh, body, 0.95));
}

}  // namespace
}  // namespace gyre

int main() {
  using namespace gyre;
  std::printf(
      "| body | noise | method | points | pieces | open edges | non-manifold | Euler (true) | median "
      "[spacings] | 95 %% |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& body : {test::sphereBody(), test::torusBody(), test::plateBody(),
                           test::cubeBody(), test::tenfoldBody()}) {
    for (const double noise_share : {0.0, 0.05, 0.1, 0.3}) {
      for (const auto& [method, word] : kMeshMethodWords) {
        if (method != MeshMethod::kAuto) printRow(body, noise_share, method);
      }
    }
  }
  return 0;
}
