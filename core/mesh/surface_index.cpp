// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_index.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr std::uint32_t kLeafSize = 4;

double squaredDistanceToBox(const Eigen::Vector3d& place, const Eigen::Vector3d& low,
                            const Eigen::Vector3d& high) {
  return (low - place).cwiseMax(place - high).cwiseMax(0.0).squaredNorm();
}

// Barycentric weights of the place on the segment ab nearest to p, the corner c having none.
Eigen::Vector3d weightsOnSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                 const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  const double squared_length = ab.squaredNorm();
  const double t =
      squared_length > 0.0 ? std::clamp((p - a).dot(ab) / squared_length, 0.0, 1.0) : 0.0;
  return {1.0 - t, t, 0.0};
}

// Barycentric weights of the place on triangle abc nearest to p: the foot of the perpendicular when
// it falls inside, else the best of the three edges. Triangles without area are their edges.
Eigen::Vector3d weightsOnTriangle(const Eigen::Vector3d& p,
                                  const std::array<Eigen::Vector3d, 3>& corner) {
  const Eigen::Vector3d ab = corner[1] - corner[0];
  const Eigen::Vector3d ac = corner[2] - corner[0];
  const Eigen::Vector3d ap = p - corner[0];
  const double d00 = ab.dot(ab);
  const double d01 = ab.dot(ac);
  const double d11 = ac.dot(ac);
  const double det = d00 * d11 - d01 * d01;
  if (det > 1e-14 * d00 * d11) {
    const double v = (d11 * ap.dot(ab) - d01 * ap.dot(ac)) / det;
    const double w = (d00 * ap.dot(ac) - d01 * ap.dot(ab)) / det;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) return {1.0 - v - w, v, w};
  }
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double best_squared = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Eigen::Vector3d on_edge = weightsOnSegment(p, corner[static_cast<std::size_t>(i)],
                                                     corner[static_cast<std::size_t>(j)]);
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
    weights[i] = on_edge[0];
    weights[j] = on_edge[1];
    const Eigen::Vector3d foot =
        weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
    const double squared = (foot - p).squaredNorm();
    if (squared < best_squared) {
      best_squared = squared;
      best = weights;
    }
  }
  return best;
}

}  // namespace

SurfaceIndex::SurfaceIndex(const Mesh& mesh) : mesh_(mesh) {
  GYRE_CHECK(!mesh.vertices.empty());
  order_.resize(mesh.triangles.empty() ? mesh.vertices.size() : mesh.triangles.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Eigen::Vector3d> centres(order_.size());
  for (std::uint32_t piece = 0; piece < order_.size(); ++piece) {
    const auto [a, b, c] = corners(piece);
    centres[piece] =
        (mesh.vertices[a].position + mesh.vertices[b].position + mesh.vertices[c].position) / 3.0;
  }
  nodes_.reserve(order_.size());
  build(0, static_cast<std::uint32_t>(order_.size()), centres);
}

Triangle SurfaceIndex::corners(std::uint32_t piece) const {
  return mesh_.triangles.empty() ? Triangle{piece, piece, piece} : mesh_.triangles[piece];
}

void SurfaceIndex::boundNode(Node& node) const {
  node.low.setConstant(std::numeric_limits<double>::infinity());
  node.high = -node.low;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    for (const std::uint32_t corner : corners(order_[i])) {
      node.low = node.low.cwiseMin(mesh_.vertices[corner].position);
      node.high = node.high.cwiseMax(mesh_.vertices[corner].position);
    }
  }
}

std::uint32_t SurfaceIndex::build(std::uint32_t begin, std::uint32_t end,
                                  const std::vector<Eigen::Vector3d>& centres) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  boundNode(node);
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return id;

  int axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) {
        return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
      });
  build(begin, middle, centres);
  nodes_[id].right = build(middle, end, centres);
  return id;
}

SurfaceHit SurfaceIndex::nearestOnPiece(const Eigen::Vector3d& place, std::uint32_t piece) const {
  const auto [a, b, c] = corners(piece);
  const std::array<Eigen::Vector3d, 3> corner = {
      mesh_.vertices[a].position, mesh_.vertices[b].position, mesh_.vertices[c].position};
  SurfaceHit hit;
  hit.piece = piece;
  hit.weights = weightsOnTriangle(place, corner);
  hit.position =
      hit.weights[0] * corner[0] + hit.weights[1] * corner[1] + hit.weights[2] * corner[2];
  hit.distance_mm = (hit.position - place).norm();
  return hit;
}

SurfaceHit SurfaceIndex::nearest(const Eigen::Vector3d& place) const {
  SurfaceHit best;
  best.distance_mm = std::numeric_limits<double>::infinity();
  struct Pending {
    std::uint32_t node;
    double squared_mm2;
  };
  std::array<Pending, 64> stack;  // a balanced tree over 32-bit indices is less deep
  std::size_t depth = 0;
  stack[depth++] = {0, 0.0};
  while (depth > 0) {
    const Pending next = stack[--depth];
    if (next.squared_mm2 >= best.distance_mm * best.distance_mm) continue;
    const Node& node = nodes_[next.node];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const SurfaceHit hit = nearestOnPiece(place, order_[i]);
        if (hit.distance_mm < best.distance_mm) best = hit;
      }
      continue;
    }
    Pending near{next.node + 1, 0.0};
    Pending far{node.right, 0.0};
    near.squared_mm2 = squaredDistanceToBox(place, nodes_[near.node].low, nodes_[near.node].high);
    far.squared_mm2 = squaredDistanceToBox(place, nodes_[far.node].low, nodes_[far.node].high);
    if (far.squared_mm2 < near.squared_mm2) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

double SurfaceIndex::viewsAt(const SurfaceHit& hit) const {
  const auto [a, b, c] = corners(hit.piece);
  return hit.weights.dot(
      Eigen::Vector3d(mesh_.vertices[a].views, mesh_.vertices[b].views, mesh_.vertices[c].views));
}

Eigen::Vector3d SurfaceIndex::normalAt(const SurfaceHit& hit) const {
  const auto [a, b, c] = corners(hit.piece);
  const Eigen::Vector3d ab = mesh_.vertices[b].position - mesh_.vertices[a].position;
  const Eigen::Vector3d ac = mesh_.vertices[c].position - mesh_.vertices[a].position;
  return ab.cross(ac).stableNormalized();
}

}  // namespace gyre
