// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh/hull_entry.h"
#include "core/mesh/ray_walk.h"

namespace gyre {
namespace {

constexpr double kViewsForTrust = 3.0;   // so many views make a point's sight count for 0.39
constexpr double kToleranceShare = 0.5;  // of the local spacing
constexpr double kToleranceSigmas = 3.0;
constexpr double kOutlineWeight = 4.0;  // of the background of one picture
constexpr float kCertain = 1e9F;
constexpr std::size_t kRaysBetweenLooks = 1024;

// Centre of the ball through a cell's corners; its radius.
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_mm = std::numeric_limits<double>::infinity();
};

Ball ballOf(const Tetrahedra& tetrahedra, std::uint32_t cell) {
  if (tetrahedra.isInfinite(cell)) return {};
  const auto& corners = tetrahedra.corners[cell];
  const Eigen::Vector3d& origin = tetrahedra.points[corners[0]];
  const Eigen::Vector3d a = tetrahedra.points[corners[1]] - origin;
  const Eigen::Vector3d b = tetrahedra.points[corners[2]] - origin;
  const Eigen::Vector3d c = tetrahedra.points[corners[3]] - origin;
  const double volume6 = a.dot(b.cross(c));
  const Eigen::Vector3d to_centre =
      (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
      (2.0 * volume6);
  if (!to_centre.allFinite()) return {};
  return {origin + to_centre, to_centre.norm()};
}

// Cosine of the angle at which the cell's ball meets its side; 1 for a ball without end.
double ballCosine(const Tetrahedra& tetrahedra, const Ball& ball, std::uint32_t cell, int side) {
  if (!std::isfinite(ball.radius_mm)) return 1.0;
  const auto [a, b, c] = tetrahedra.side(cell, side);
  const auto& points = tetrahedra.points;
  const Eigen::Vector3d outward =
      (points[b] - points[a]).cross(points[c] - points[a]).stableNormalized();
  return std::clamp(outward.dot(points[a] - ball.centre) / ball.radius_mm, -1.0, 1.0);
}

void addQuality(const Tetrahedra& tetrahedra, double weight, CellGraph& graph) {
  std::vector<Ball> balls;
  balls.reserve(tetrahedra.cells());
  for (std::uint32_t cell = 0; cell < tetrahedra.cells(); ++cell) {
    balls.push_back(ballOf(tetrahedra, cell));
  }
  for (std::uint32_t cell = 0; cell < tetrahedra.cells(); ++cell) {
    for (int side = 0; side < 4; ++side) {
      const auto at = static_cast<std::size_t>(side);
      const std::uint32_t next = tetrahedra.neighbours[cell][at];
      if (next < cell || tetrahedra.isInfinite(cell, side)) continue;
      const auto mirror = tetrahedra.mirrors[cell][at];
      const double cosine =
          std::min(ballCosine(tetrahedra, balls[cell], cell, side),
                   ballCosine(tetrahedra, balls[next], next, static_cast<int>(mirror)));
      const auto cost = static_cast<float>(weight * (1.0 - cosine));
      graph.arc_costs[cell][at] += cost;
      graph.arc_costs[next][mirror] += cost;
    }
  }
}

class SightVotes {
 public:
  SightVotes(const Tetrahedra& tetrahedra, CellGraph& graph)
      : tetrahedra_(tetrahedra), around_(tetrahedra), graph_(graph) {}

  // A camera saw the point.
  void addSight(std::uint32_t point, const Point& seen, const Eigen::Vector3d& camera,
                double weight, double tolerance_mm) {
    const Eigen::Vector3d& place = tetrahedra_.points[point];
    const Eigen::Vector3d offset = camera - place;
    const double length_mm = offset.norm();
    if (!(length_mm > 0.0)) return;
    const Eigen::Vector3d towards = offset / length_mm;
    if (const auto start = cellTowards(tetrahedra_, around_, point, towards)) {
      const auto end =
          walkCells(tetrahedra_, *start, Ray{place, towards}, length_mm,
                    [&](std::uint32_t cell, const CellExit& exit) {
                      const double off = exit.distance_mm / tolerance_mm;
                      addBefore(cell, exit.side, weight * (1.0 - std::exp(-0.5 * off * off)));
                    });
      if (!tetrahedra_.isInfinite(end)) graph_.sink_costs[end] += static_cast<float>(weight);
    }
    const double facing = seen.normal.isZero() ? 1.0 : seen.normal.dot(towards);
    if (facing > 0.0) addBehind(point, -towards, weight * facing, tolerance_mm);
  }

  // Nothing stands on the rays from the camera that took this picture.
  void addBackground(const std::vector<Ray>& rays, std::uint32_t picture) {
    if (rays.empty()) return;
    if (spoken_.empty()) spoken_.assign(tetrahedra_.cells(), {});
    const HullEntry hull(tetrahedra_, rays.front().origin);
    for (const Ray& ray : rays) {
      const auto entry = hull.of(ray.direction);
      if (!entry) continue;
      const auto side = static_cast<std::size_t>(entry->side);
      addOnce(entry->cell, side, picture);
      walkCells(tetrahedra_, tetrahedra_.neighbours[entry->cell][side], ray,
                std::numeric_limits<double>::infinity(),
                [&](std::uint32_t cell, const CellExit& exit) {
                  addOnce(cell, static_cast<std::size_t>(exit.side), picture);
                });
    }
  }

 private:
  // Costs when the cell is solid though what lies before it, beyond the side, is outside.
  void addBefore(std::uint32_t cell, int side, double cost) {
    const auto at = static_cast<std::size_t>(side);
    graph_.arc_costs[tetrahedra_.neighbours[cell][at]][tetrahedra_.mirrors[cell][at]] +=
        static_cast<float>(cost);
  }

  // Costs when the cell is outside though what lies beyond the side is solid.
  void addOnce(std::uint32_t cell, std::size_t side, std::uint32_t picture) {
    if (spoken_[cell][side] == picture + 1) return;
    spoken_[cell][side] = picture + 1;
    graph_.arc_costs[cell][side] += static_cast<float>(kOutlineWeight);
  }

  void addBehind(std::uint32_t point, const Eigen::Vector3d& away, double weight,
                 double tolerance_mm) {
    const auto start = cellTowards(tetrahedra_, around_, point, away);
    if (!start) return;
    std::uint32_t last = *start;
    const auto end =
        walkCells(tetrahedra_, *start, Ray{tetrahedra_.points[point], away}, tolerance_mm,
                  [&](std::uint32_t cell, const CellExit&) { last = cell; });
    if (!tetrahedra_.isInfinite(end)) last = end;
    graph_.source_costs[last] += static_cast<float>(weight);
  }

  const Tetrahedra& tetrahedra_;
  CellsAround around_;
  CellGraph& graph_;
  std::vector<Tetrahedra::Cell> spoken_;  // of each side: 1 + the last picture that spoke of it
};

double toleranceOf(const Point& point, double spacing_mm) {
  return std::max(kToleranceShare * spacing_mm, kToleranceSigmas * sigmaAlongNormal(point));
}

}  // namespace

Result<CellGraph> freeSpaceGraph(const Tetrahedra& tetrahedra, const SurfacePoints& points,
                                 const SightEvidence& evidence, const VisibilityCutOptions& options,
                                 const Task& task) {
  CellGraph graph;
  graph.neighbours = tetrahedra.neighbours;
  graph.mirrors = tetrahedra.mirrors;
  graph.arc_costs.resize(tetrahedra.cells());
  graph.sink_costs.resize(tetrahedra.cells());
  graph.source_costs.resize(tetrahedra.cells());
  for (std::uint32_t cell = 0; cell < tetrahedra.cells(); ++cell) {
    if (tetrahedra.isInfinite(cell)) graph.sink_costs[cell] = kCertain;
  }
  addQuality(tetrahedra, options.quality, graph);

  SightVotes votes(tetrahedra, graph);
  const auto count = static_cast<std::uint32_t>(points.cloud.points.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % kRaysBetweenLooks == 0) {
      if (task.stopRequested()) return cancelled();
      task.report(static_cast<double>(i) / count, "Following lines of sight");
    }
    const Point& point = points.cloud.points[i];
    const auto views = spreadViews(point, evidence.camera_centres.size(),
                                   static_cast<std::size_t>(options.rays_per_point));
    const double trust = static_cast<double>(point.views.size()) / kViewsForTrust;
    const double weight = 1.0 - std::exp(-0.5 * trust * trust);
    for (const std::uint32_t view : views) {
      votes.addSight(i, point, evidence.camera_centres[view], weight,
                     toleranceOf(point, points.spacing_mm[i]));
    }
  }
  for (std::uint32_t picture = 0; picture < evidence.background.size(); ++picture) {
    if (task.stopRequested()) return cancelled();
    votes.addBackground(evidence.background[picture], picture);
  }
  return graph;
}

}  // namespace gyre
