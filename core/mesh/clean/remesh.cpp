// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/remesh.h"

#include <cmath>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include "core/base/units.h"
#include "core/mesh/clean/blend.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/unseen_patch.h"
#include "core/mesh/edges.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

using Features = SurfaceMesh::Property_map<SurfaceMesh::Edge_index, bool>;

constexpr double kMaxTriangles = 1e7;

// An even triangle of edge L has the area sqrt(3) / 4 L^2.
double triangleCount(const Mesh& mesh, double edge_mm) {
  return meshHealth(mesh).area_mm2 / (std::sqrt(3.0) / 4.0 * edge_mm * edge_mm);
}

double meanEdge_mm(const Mesh& mesh) {
  double sum_mm = 0.0;
  std::size_t count = 0;
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto /*end*/) {
    sum_mm += (mesh.vertices[begin->low].position - mesh.vertices[begin->high].position).norm();
    ++count;
  });
  return sum_mm / static_cast<double>(count);
}

// Where exactly two features meet, a line of features goes on, and must turn to have a corner
// there.
bool isCorner(const SurfaceMesh& surface, SurfaceMesh::Vertex_index vertex,
              const Features& is_feature, double sharp_deg) {
  std::vector<Eigen::Vector3d> along;
  for (const auto half : surface.halfedges_around_target(surface.halfedge(vertex))) {
    if (!is_feature[surface.edge(half)]) continue;
    const auto way = surface.point(surface.source(half)) - surface.point(vertex);
    along.push_back(Eigen::Vector3d(way.x(), way.y(), way.z()).stableNormalized());
  }
  return along.size() == 2 && -along[0].dot(along[1]) < std::cos(radFromDeg(sharp_deg));
}

// Rims are features by themselves.
void remesh(SurfaceMesh& surface, const RemeshOptions& options) {
  Features is_feature =
      surface.add_property_map<SurfaceMesh::Edge_index, bool>("e:feature", false).first;
  auto is_corner =
      surface.add_property_map<SurfaceMesh::Vertex_index, bool>("v:corner", false).first;
  pmp::detect_sharp_edges(surface, options.sharp_deg, is_feature);
  for (const auto edge : surface.edges()) {
    if (surface.is_border(edge)) is_feature[edge] = true;
  }
  for (const auto vertex : surface.vertices()) {
    if (surface.is_isolated(vertex)) continue;
    is_corner[vertex] = isCorner(surface, vertex, is_feature, options.sharp_deg);
  }
  pmp::isotropic_remeshing(
      surface.faces(), options.edge_mm, surface,
      CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.iterations))
          .edge_is_constrained_map(is_feature)
          .vertex_is_constrained_map(is_corner)
          .number_of_relaxation_steps(3U));
}

}  // namespace

Result<RemeshedMesh> remeshEvenly(const Mesh& mesh, const RemeshOptions& options,
                                  const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  if (task.stopRequested()) return cancelled();
  if (options.edge_mm == 0.0) return RemeshedMesh{mesh, meanEdge_mm(mesh)};
  if (triangleCount(mesh, options.edge_mm) > kMaxTriangles) {
    return Error{Error::Code::kInvalidInput,
                 "Edges so short would make more than ten million triangles.",
                 "Choose longer edges."};
  }
  task.report(0.0, "Making triangles even");
  return guarded("The remeshing", [&]() -> Result<RemeshedMesh> {
    SurfaceMesh surface = surfaceMeshOf<SurfaceMesh>(mesh);
    remesh(surface, options);
    if (task.stopRequested()) return cancelled();
    RemeshedMesh remeshed;
    remeshed.mesh = meshOf(surface);
    carryAttributes(mesh, remeshed.mesh);
    divideSeenTriangles(remeshed.mesh, seenOverUnseen(mesh, remeshed.mesh));
    computeNormals(remeshed.mesh);
    remeshed.mean_edge_mm = meanEdge_mm(remeshed.mesh);
    return remeshed;
  });
}

}  // namespace gyre
