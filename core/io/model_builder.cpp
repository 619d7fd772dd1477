// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gyre {
namespace {

// Other programs write normals of any length, and NaN where they know none.
void tidy(ModelVertex& entry) {
  Eigen::Vector3d& normal = entry.vertex.normal;
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    normal.setZero();
  } else if (std::abs(length - 1.0) > 1e-3) {
    normal /= length;
  }
  float& sigma_mm = entry.vertex.sigma_mm;
  if (!(sigma_mm >= 0.0F) || !std::isfinite(sigma_mm)) sigma_mm = 0.0F;
  if (!entry.covariance.allFinite()) entry.covariance.setZero();
}

// A file that tells only sigma says nothing of directions: the same in each.
Point pointOf(const ModelVertex& entry) {
  Point point;
  point.position = entry.vertex.position;
  point.normal = entry.vertex.normal;
  point.rgb = entry.vertex.rgb;
  point.covariance = entry.covariance;
  if (point.covariance.isZero(0.0)) {
    const double sigma_mm = entry.vertex.sigma_mm;
    point.covariance.diagonal().setConstant(sigma_mm * sigma_mm / 3.0);
  }
  return point;
}

}  // namespace

void ModelBuilder::addFace(std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles_.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

ModelBuilder::Outcome ModelBuilder::finish() {
  const auto entries = std::exchange(vertices, {});
  Mesh mesh;
  mesh.triangles = std::exchange(triangles_, {});
  if (entries.empty()) return {{}, "has no points"};
  for (const Triangle& triangle : mesh.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= entries.size()) {
      return {{}, "has a face with a corner that does not exist"};
    }
  }
  PointCloud cloud;
  for (ModelVertex entry : entries) {
    if (!entry.vertex.position.allFinite()) return {{}, "has a position that is no number"};
    tidy(entry);
    if (mesh.triangles.empty()) {
      cloud.points.push_back(pointOf(entry));
    } else {
      mesh.vertices.push_back(entry.vertex);
    }
  }
  if (mesh.triangles.empty()) return {std::move(cloud), std::nullopt};
  return {std::move(mesh), std::nullopt};
}

}  // namespace gyre
