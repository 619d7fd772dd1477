// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>
#include <vector>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/local_surface.h"

namespace gyre {
namespace {

using Normals = std::vector<Eigen::Vector3d>;

// Of the angle between two directions of any length; 1 when one of them is unknown.
double cosine(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double lengths = a.norm() * b.norm();
  return lengths > 0.0 ? a.dot(b) / lengths : 1.0;
}

Eigen::Vector3d meanOf(const KdTree& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint32_t i = 0; i < points.size(); ++i) sum += points.point(i);
  return sum / static_cast<double>(points.size());
}

// Spreads the sign of the normals from points where it is known to those where it is not, along
// the pairs of neighbours whose normals are most nearly parallel first (Hoppe et al. 1992, 3.3).
class SignSpreader {
 public:
  SignSpreader(const KdTree& points, Normals& normals, std::vector<char> known, std::size_t count)
      : points_(points), normals_(normals), known_(std::move(known)), count_(count) {}

  void spread() {
    for (std::uint32_t i = 0; i < known_.size(); ++i) {
      if (known_[i]) pushNeighbours(i);
    }
    drain();
    for (const std::uint32_t seed : fromHighest()) {
      if (known_[seed]) continue;
      lookOutward(seed);
      known_[seed] = 1;
      pushNeighbours(seed);
      drain();
    }
  }

 private:
  struct Step {
    double agreement;
    std::uint32_t from;
    std::uint32_t to;
    bool operator<(const Step& other) const {
      if (agreement != other.agreement) return agreement < other.agreement;
      return std::tie(from, to) > std::tie(other.from, other.to);
    }
  };

  void pushNeighbours(std::uint32_t from) {
    if (normals_[from].isZero()) return;
    for (const auto& [to, squared] : points_.nearest(points_.point(from), count_)) {
      if (known_[to]) continue;
      queue_.push({std::abs(normals_[from].dot(normals_[to])), from, to});
    }
  }

  void drain() {
    while (!queue_.empty()) {
      const Step step = queue_.top();
      queue_.pop();
      if (known_[step.to]) continue;
      if (normals_[step.from].dot(normals_[step.to]) < 0.0) normals_[step.to] *= -1.0;
      known_[step.to] = 1;
      pushNeighbours(step.to);
    }
  }

  std::vector<std::uint32_t> fromHighest() const {
    std::vector<std::uint32_t> order(points_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return points_.point(a).z() > points_.point(b).z();
    });
    return order;
  }

  void lookOutward(std::uint32_t seed) {
    const Eigen::Vector3d outward =
        (points_.point(seed) - meanOf(points_)).stableNormalized() + Eigen::Vector3d::UnitZ();
    if (normals_[seed].dot(outward) < 0.0) normals_[seed] *= -1.0;
  }

  const KdTree& points_;
  Normals& normals_;
  std::vector<char> known_;
  std::size_t count_;
  std::priority_queue<Step> queue_;
};

}  // namespace

Result<void> setPointNormals(PointCloud& cloud, std::span<const Eigen::Vector3d> towards_camera,
                             const PointNormalOptions& options, const Task& task) {
  GYRE_CHECK(towards_camera.empty() || towards_camera.size() == cloud.points.size());
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  const KdTree points(std::move(positions));

  Normals normals(points.size(), Eigen::Vector3d::Zero());
  std::vector<char> known(points.size(), 0);
  parallelFor(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& place = cloud.points[i].position;
      auto neighbours = points.nearest(place, options.neighbours);
      if (!towards_camera.empty()) {
        std::erase_if(neighbours, [&](const KdTree::Neighbour& neighbour) {
          return cosine(towards_camera[i], towards_camera[neighbour.index]) <
                 options.min_shared_view;
        });
      }
      const auto surface = fitLocalSurface(points, place, neighbours);
      known[i] = !surface;
      if (!surface) continue;
      normals[i] = surface->normal;
      if (towards_camera.empty()) continue;
      const double facing = surface->normal.dot(towards_camera[i].stableNormalized());
      if (facing < 0.0) normals[i] *= -1.0;
      known[i] = std::abs(facing) >= options.min_facing;
    }
  });
  if (task.stopRequested()) return cancelled();
  SignSpreader(points, normals, std::move(known), options.neighbours).spread();
  for (std::size_t i = 0; i < normals.size(); ++i) cloud.points[i].normal = normals[i];
  return {};
}

}  // namespace gyre
