// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_samples.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/random.h"

namespace gyre {
namespace {

constexpr std::uint64_t kSeed = 0x73616D706C65;

// Area of the triangles up to and including each. [mm^2]
std::vector<double> runningArea(const Mesh& mesh) {
  std::vector<double> area(mesh.triangles.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d ab = mesh.vertices[b].position - mesh.vertices[a].position;
    const Eigen::Vector3d ac = mesh.vertices[c].position - mesh.vertices[a].position;
    sum += 0.5 * ab.cross(ac).norm();
    area[i] = sum;
  }
  return area;
}

// Uniform in the triangle: the square root turns two uniform numbers into even barycentric weights.
SurfaceSample sampleTriangle(const Mesh& mesh, const Triangle& triangle, Random& random) {
  const double root = std::sqrt(random.uniform());
  const double split = random.uniform();
  const Eigen::Vector3d weights(1.0 - root, root * (1.0 - split), root * split);
  SurfaceSample sample;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const MeshVertex& vertex = mesh.vertices[triangle[corner]];
    const double weight = weights[static_cast<Eigen::Index>(corner)];
    sample.position += weight * vertex.position;
    sample.views += weight * vertex.views;
  }
  return sample;
}

}  // namespace

std::vector<SurfaceSample> sampleSurface(const Mesh& mesh, std::size_t count) {
  std::vector<SurfaceSample> samples;
  if (mesh.triangles.empty()) {
    samples.reserve(mesh.vertices.size());
    for (const MeshVertex& vertex : mesh.vertices) {
      samples.push_back({vertex.position, static_cast<double>(vertex.views)});
    }
    return samples;
  }
  const std::vector<double> area = runningArea(mesh);
  if (!(area.back() > 0.0)) return samples;
  samples.reserve(count);
  Random random(kSeed);
  for (std::size_t i = 0; i < count; ++i) {
    const double at =
        (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * area.back();
    const auto found = std::upper_bound(area.begin(), area.end(), at);
    const auto triangle = std::min(static_cast<std::size_t>(found - area.begin()), area.size() - 1);
    samples.push_back(sampleTriangle(mesh, mesh.triangles[triangle], random));
  }
  return samples;
}

}  // namespace gyre
