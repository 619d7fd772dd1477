// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/foreign_model.h"

#include <cmath>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "core/base/units.h"

namespace gyre::test {
namespace {

Eigen::Vector3d vectorOf(const aiVector3D& vector) { return {vector.x, vector.y, vector.z}; }

ForeignCorner cornerOf(const aiMesh& mesh, unsigned int index) {
  ForeignCorner corner;
  corner.position = vectorOf(mesh.mVertices[index]);
  if (mesh.HasNormals()) corner.normal = vectorOf(mesh.mNormals[index]);
  if (mesh.HasVertexColors(0)) {
    const aiColor4D& colour = mesh.mColors[0][index];
    corner.colour = {colour.r, colour.g, colour.b};
  }
  return corner;
}

}  // namespace

ForeignModel readByAssimp(const std::filesystem::path& file) {
  ForeignModel model;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_PreTransformVertices);
  if (scene == nullptr) return model;
  for (unsigned int i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    for (unsigned int j = 0; j < mesh.mNumFaces; ++j) {
      const aiFace& face = mesh.mFaces[j];
      if (face.mNumIndices != 3) continue;
      ForeignTriangle& triangle = model.triangles.emplace_back();
      for (unsigned int k = 0; k < 3; ++k) {
        triangle.at(k) = cornerOf(mesh, face.mIndices[k]);
        model.bounds.include(triangle.at(k).position);
      }
    }
  }
  return model;
}

Mesh hoveringEgg() {
  constexpr std::uint32_t kRings = 12;
  constexpr std::uint32_t kAround = 20;
  Mesh mesh;
  mesh.vertices.emplace_back().position = {-300.0, 0.0, -80.0};  // of no triangle
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    const double polar_rad = kPi * (ring + 0.5) / kRings;
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double turn_rad = 2.0 * kPi * i / kAround;
      MeshVertex& vertex = mesh.vertices.emplace_back();
      vertex.position = {11.5 + 8.0 * std::sin(polar_rad) * std::cos(turn_rad),
                         -3.25 + 7.0 * std::sin(polar_rad) * std::sin(turn_rad),
                         12.4 + 12.0 * std::cos(polar_rad) / std::cos(0.5 * kPi / kRings)};
      vertex.rgb = {static_cast<std::uint8_t>(21 * ring), static_cast<std::uint8_t>(12 * i),
                    static_cast<std::uint8_t>(ring + i)};
      vertex.seen = ring + 1 < kRings ? 1 : 0;
    }
  }
  const auto at = [](std::uint32_t ring, std::uint32_t i) {
    return 1 + ring * kAround + i % kAround;
  };
  for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
  }
  for (std::uint32_t i = 1; i + 1 < kAround; ++i) {
    mesh.triangles.push_back({at(0, 0), at(0, i), at(0, i + 1)});
    mesh.triangles.push_back({at(kRings - 1, 0), at(kRings - 1, i + 1), at(kRings - 1, i)});
  }
  mesh.triangles.push_back({5, 5, 9});
  computeNormals(mesh);
  return mesh;
}

}  // namespace gyre::test
