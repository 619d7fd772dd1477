// Between this program's meshes and half-edge meshes like CGAL's Surface_mesh, and the calls there.
// Only for the .cpp files of this folder: the mesh type is theirs to choose.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scan/mesh.h"

namespace gyre {

inline Error libraryError(const std::string& what_failed, const std::string& why) {
  return {Error::Code::kInternal, what_failed + " failed: " + why + ".",
          "Please report this with the mesh."};
}

// What the work gives; what it throws as an error that begins with "WHAT failed".
template <class Work>
auto guarded(const std::string& what, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::exception& problem) {
    return libraryError(what, problem.what());
  }
}

// Vertices keep their numbers. The mesh has passed checkSurface.
template <class SurfaceMesh>
SurfaceMesh surfaceMeshOf(const Mesh& mesh) {
  using Index = typename SurfaceMesh::Vertex_index;
  using Size = typename SurfaceMesh::size_type;
  SurfaceMesh surface;
  const auto triangles = static_cast<Size>(mesh.triangles.size());
  surface.reserve(static_cast<Size>(mesh.vertices.size()), 3 * (triangles / 2), triangles);
  for (const MeshVertex& vertex : mesh.vertices) {
    surface.add_vertex({vertex.position.x(), vertex.position.y(), vertex.position.z()});
  }
  for (const auto& [a, b, c] : mesh.triangles) surface.add_face(Index(a), Index(b), Index(c));
  return surface;
}

// Vertices and triangles in the order of the surface, without what was removed from it; vertices
// have a position only.
template <class SurfaceMesh>
Mesh meshOf(const SurfaceMesh& surface) {
  Mesh mesh;
  std::vector<std::uint32_t> number(surface.num_vertices());
  mesh.vertices.reserve(surface.number_of_vertices());
  mesh.triangles.reserve(surface.number_of_faces());
  for (const auto vertex : surface.vertices()) {
    const auto& point = surface.point(vertex);
    number[vertex] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back();
    mesh.vertices.back().position = {point.x(), point.y(), point.z()};
  }
  for (const auto face : surface.faces()) {
    Triangle triangle{};
    std::size_t place = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
      triangle[place++] = number[vertex];
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace gyre
