// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/fill_holes.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/unseen_patch.h"

namespace gyre {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Longer rims are filled by the Delaunay triangles of their vertices or not at all: the search
// through all triangulations grows with the cube of their length.
constexpr std::size_t kMaxSearchedRim = 400;

struct Rim {
  SurfaceMesh::Halfedge_index border;
  std::vector<std::uint32_t> vertices;
  Bounds bounds;
};

Eigen::Vector3d positionOf(const SurfaceMesh& surface, SurfaceMesh::Vertex_index vertex) {
  const auto& point = surface.point(vertex);
  return {point.x(), point.y(), point.z()};
}

std::vector<Rim> findRims(const SurfaceMesh& surface) {
  std::vector<SurfaceMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
  std::vector<Rim> rims;
  for (const auto border : borders) {
    Rim rim;
    rim.border = border;
    for (const auto vertex : surface.vertices_around_face(border)) {
      rim.vertices.push_back(vertex);
      rim.bounds.include(positionOf(surface, vertex));
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

// Colour of the rim as seen from the place: each vertex weighs with its inverse squared distance.
Rgb colourFrom(const Mesh& mesh, const Rim& rim, const Eigen::Vector3d& place) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const std::uint32_t v : rim.vertices) {
    const MeshVertex& vertex = mesh.vertices[v];
    const double weight = 1.0 / std::max(1e-12, (vertex.position - place).squaredNorm());
    sum += weight * Eigen::Vector3d(vertex.rgb[0], vertex.rgb[1], vertex.rgb[2]);
    weights += weight;
  }
  const Eigen::Vector3d mean = (sum / weights).array().round();
  return {static_cast<std::uint8_t>(mean[0]), static_cast<std::uint8_t>(mean[1]),
          static_cast<std::uint8_t>(mean[2])};
}

// Bending that runs away over a ragged rim is worse than a filling that only spans it.
void calm(SurfaceMesh& surface, const Rim& rim,
          const std::vector<SurfaceMesh::Vertex_index>& made) {
  const Eigen::Vector3d centre = 0.5 * (rim.bounds.min + rim.bounds.max);
  const bool ran_away = std::any_of(made.begin(), made.end(), [&](const auto vertex) {
    return !((positionOf(surface, vertex) - centre).norm() <= rim.bounds.diagonal());
  });
  if (ran_away) pmp::fair(surface, made, CGAL::parameters::fairing_continuity(0));
}

// Fills one hole and appends what it made; tells whether it could.
bool fillOne(SurfaceMesh& surface, const Rim& rim, FilledMesh& filled) {
  std::vector<SurfaceMesh::Face_index> faces;
  std::vector<SurfaceMesh::Vertex_index> made;
  pmp::triangulate_refine_and_fair_hole(
      surface, rim.border, std::back_inserter(faces), std::back_inserter(made),
      CGAL::parameters::do_not_use_cubic_algorithm(rim.vertices.size() > kMaxSearchedRim));
  if (faces.empty()) return false;
  calm(surface, rim, made);
  filled.mesh.vertices.resize(surface.num_vertices());
  for (const auto vertex : made) {
    const Eigen::Vector3d position = positionOf(surface, vertex);
    filled.mesh.vertices[vertex] = unseenVertex(position, colourFrom(filled.mesh, rim, position));
  }
  for (const auto face : faces) {
    Triangle triangle{};
    std::size_t place = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
      triangle[place++] = vertex;
    }
    filled.mesh.triangles.push_back(triangle);
  }
  return true;
}

double areaFrom(const Mesh& mesh, std::size_t first) {
  double sum_mm2 = 0.0;
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d& at = mesh.vertices[a].position;
    sum_mm2 += 0.5 * (mesh.vertices[b].position - at).cross(mesh.vertices[c].position - at).norm();
  }
  return sum_mm2;
}

}  // namespace

Result<FilledMesh> fillHoles(const Mesh& mesh, const FillHolesOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  return guarded("The filling of holes", [&]() -> Result<FilledMesh> {
    FilledMesh filled;
    filled.mesh = mesh;
    SurfaceMesh surface = surfaceMeshOf<SurfaceMesh>(mesh);
    const std::vector<Rim> rims = findRims(surface);
    for (std::size_t i = 0; i < rims.size(); ++i) {
      if (task.stopRequested()) return cancelled();
      task.report(static_cast<double>(i) / static_cast<double>(rims.size()), "Filling holes");
      const Bounds& bounds = rims[i].bounds;
      const bool wanted =
          bounds.diagonal() <= options.max_width_mm && bounds.max.z() > options.spare_below_mm;
      if (wanted && fillOne(surface, rims[i], filled)) {
        ++filled.holes_filled;
      } else {
        ++filled.holes_left;
      }
    }
    filled.filled_mm2 = areaFrom(filled.mesh, mesh.triangles.size());
    divideSeenTriangles(filled.mesh, static_cast<std::uint32_t>(mesh.triangles.size()));
    computeNormals(filled.mesh);
    return filled;
  });
}

}  // namespace gyre
