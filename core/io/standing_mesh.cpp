// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/standing_mesh.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr std::size_t kMostTriangles = 40'000'000;
constexpr double kFarthest_mm = 1e6;
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

Error unwritable(const std::string& problem, const std::string& advice) {
  return {Error::Code::kInvalidInput, "The surface " + problem + ".", advice};
}

bool hasArea(const Triangle& triangle) {
  return triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
}

// The mesh without what nobody would see.
Mesh surfaceOf(const Mesh& mesh) {
  Mesh surface;
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kUnused);
  surface.triangles.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    if (!hasArea(triangle)) continue;
    Triangle& renamed = surface.triangles.emplace_back();
    for (std::size_t i = 0; i < renamed.size(); ++i) {
      GYRE_CHECK(triangle[i] < mesh.vertices.size());
      std::uint32_t& index = new_index[triangle[i]];
      if (index == kUnused) {
        index = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.push_back(mesh.vertices[triangle[i]]);
      }
      renamed[i] = index;
    }
  }
  return surface;
}

bool isUnit(const Eigen::Vector3d& normal) {
  const double length = normal.norm();
  return length > 0.99 && length < 1.01;  // as near as floats and foreign files come
}

void giveNormals(Mesh& mesh) {
  const bool complete = std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                                    [](const MeshVertex& vertex) { return isUnit(vertex.normal); });
  if (complete) return;
  Mesh shaded = mesh;
  computeNormals(shaded);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Eigen::Vector3d& normal = mesh.vertices[i].normal;
    if (isUnit(normal)) continue;
    normal = shaded.vertices[i].normal;
    if (!isUnit(normal)) normal = Eigen::Vector3d::UnitZ();  // between triangles without area
  }
}

}  // namespace

Result<Mesh> standingMesh(const Mesh& mesh) {
  if (mesh.triangles.size() > kMostTriangles) {
    return unwritable("has too many triangles to be written: " +
                          std::to_string(mesh.triangles.size()) + " of at most 40 million",
                      "Make the surface coarser.");
  }
  Mesh standing = surfaceOf(mesh);
  if (standing.triangles.empty()) {
    return unwritable("has no triangle", "Make a surface of the points first.");
  }
  double lowest_mm = std::numeric_limits<double>::max();
  for (const MeshVertex& vertex : standing.vertices) {
    const Eigen::Vector3d& position = vertex.position;
    if (!position.allFinite() || position.cwiseAbs().maxCoeff() > kFarthest_mm) {
      return unwritable("has a corner that is nowhere", "Make the surface of the points anew.");
    }
    lowest_mm = std::min(lowest_mm, position.z());
  }
  for (MeshVertex& vertex : standing.vertices) vertex.position.z() -= lowest_mm;
  giveNormals(standing);
  return standing;
}

}  // namespace gyre
