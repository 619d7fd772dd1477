// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/rim_slopes.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace gyre {
namespace {

constexpr double kLooksDown = -0.15;  // z of a vertex's normal
constexpr std::size_t kNearest = 40;  // vertices that are asked
constexpr Eigen::Index kFewest = 12;  // of them that look down and are near: a parabola has six
constexpr double kSteepest = 2.5;     // rise over run

// Of each vertex, from the triangles that are not guessed; along the mean normal.
std::vector<Eigen::Vector3d> normalsOf(const Mesh& mesh, std::span<const std::uint32_t> guessed) {
  std::vector<char> is_guessed(mesh.triangles.size(), 0);
  for (const std::uint32_t t : guessed) is_guessed[t] = 1;
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_guessed[t] != 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d& first = mesh.vertices[a].position;
    const Eigen::Vector3d area =
        (mesh.vertices[b].position - first).cross(mesh.vertices[c].position - first);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += area;
  }
  return normals;
}

}  // namespace

RimSlopes::RimSlopes(const Mesh& mesh, std::span<const std::uint32_t> guessed) {
  const std::vector<Eigen::Vector3d> normals = normalsOf(mesh, guessed);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.vertices[v].seen == 0 || normals[v].isZero()) continue;
    places_.push_back(mesh.vertices[v].position);
    looks_down_.push_back(normals[v].stableNormalized().z() < kLooksDown ? 1 : 0);
  }
  if (!places_.empty()) tree_.emplace(places_);
}

std::optional<Eigen::Vector2d> RimSlopes::at(const Eigen::Vector3d& place, double reach_mm) const {
  if (!tree_) return std::nullopt;
  std::vector<Eigen::Vector3d> near;
  std::size_t walls = 0;
  for (const auto& neighbour : tree_->nearest(place, kNearest)) {
    if (neighbour.squared_mm2 > reach_mm * reach_mm) continue;
    if (looks_down_[neighbour.index] != 0) {
      near.push_back((places_[neighbour.index] - place) / reach_mm);
    } else {
      ++walls;
    }
  }
  const auto count = static_cast<Eigen::Index>(near.size());
  if (count < kFewest || walls > near.size()) return std::nullopt;
  Eigen::MatrixXd terms(count, 6);
  Eigen::VectorXd heights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d& at = near[static_cast<std::size_t>(i)];
    terms.row(i) << 1.0, at.x(), at.y(), at.x() * at.x(), at.x() * at.y(), at.y() * at.y();
    heights[i] = at.z();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(terms);
  solver.setThreshold(1e-3);
  if (solver.rank() < 6) return std::nullopt;
  const Eigen::VectorXd parabola = solver.solve(heights);
  const Eigen::Vector2d slope = parabola.segment<2>(1);
  if (!(slope.norm() <= kSteepest)) return std::nullopt;
  return slope;
}

}  // namespace gyre
