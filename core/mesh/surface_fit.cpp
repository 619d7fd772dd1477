// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/mesh/small_motion.h"
#include "core/mesh/surface_index.h"

namespace gyre {
namespace {

constexpr std::size_t kMostPoints = 10000;  // of each surface: far more than six unknowns need
constexpr int kMostRounds = 60;
constexpr double kReachShare = 0.02;  // of the size: how far overlapping surfaces may lie apart
constexpr double kReachScales = 6.0;  // and of how closely they agree
constexpr double kLeastReachShare = 5e-4;
constexpr double kFacing_deg = 45.0;
constexpr double kCauchy = 2.4;       // 95 % efficient on a normal distribution
constexpr double kGaussian = 1.4826;  // standard deviation of a median distance
constexpr double kConverged = 1e-7;   // of the size
constexpr std::size_t kLeastTies = 200;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// What a place of the moving surface should become, along one direction; or in all, normal zero.
struct Tie {
  Eigen::Vector3d moved;   // where it now lies, in the fixed frame
  Eigen::Vector3d target;  // likewise
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();

  double distance() const {
    const Eigen::Vector3d off = moved - target;
    return normal.isZero() ? off.norm() : std::abs(normal.dot(off));
  }
};

std::vector<Point> sampled(const PointCloud& cloud) {
  std::vector<Point> samples;
  const std::size_t stride = (cloud.points.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) samples.push_back(cloud.points[i]);
  return samples;
}

// Where a point lies on the surface; nothing where that was not seen or faces another way.
std::optional<SurfaceHit> seenPlace(const SurfaceIndex& index, const Mesh& mesh,
                                    const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                                    double reach_mm) {
  static const double kLeastCosine = std::cos(radFromDeg(kFacing_deg));
  const SurfaceHit hit = index.nearest(place);
  if (hit.distance_mm > reach_mm) return std::nullopt;
  for (const std::uint32_t vertex : mesh.triangles[hit.piece]) {
    if (mesh.vertices[vertex].seen == 0) return std::nullopt;
  }
  if (index.normalAt(hit).dot(normal) < kLeastCosine) return std::nullopt;
  return hit;
}

// Of the surface at the hit, blended between its vertices, and of the point: the normal of the
// triangle itself is as rough as the points are, and would hold in place what slides freely.
Eigen::Vector3d smoothNormal(const Mesh& mesh, const SurfaceHit& hit,
                             const Eigen::Vector3d& normal_of_point) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    normal += hit.weights[static_cast<Eigen::Index>(i)] *
              mesh.vertices[mesh.triangles[hit.piece][i]].normal;
  }
  return (normal.normalized() + normal_of_point).normalized();
}

// Points of one surface on the other.
std::vector<Tie> tiesOf(const std::vector<Point>& points, const SurfaceIndex& index,
                        const Mesh& mesh, const Rigid3& to_mesh, double reach_mm) {
  std::vector<std::optional<Tie>> found(points.size());
  parallelFor(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d place = to_mesh * points[i].position;
      const Eigen::Vector3d normal = to_mesh.rotation * points[i].normal;
      const auto hit = seenPlace(index, mesh, place, normal, reach_mm);
      if (hit) found[i] = Tie{place, hit->position, smoothNormal(mesh, *hit, normal)};
    }
  });
  std::vector<Tie> ties;
  for (const auto& tie : found) {
    if (tie) ties.push_back(*tie);
  }
  return ties;
}

double scaleOf(const std::vector<Tie>& ties) {
  std::vector<double> distances;
  distances.reserve(ties.size());
  for (const Tie& tie : ties) distances.push_back(tie.distance());
  return distances.empty() ? 0.0 : kGaussian * median(std::move(distances));
}

// The normal equations of a small motion about `centre`.
class Equations {
 public:
  Equations(const Eigen::Vector3d& centre, double size_mm) : centre_(centre), size_mm_(size_mm) {}

  // Weighted by how closely ties of this kind agree.
  void add(const std::vector<Tie>& ties, double floor_mm) {
    const double scale_mm = std::max(scaleOf(ties), floor_mm);
    for (const Tie& tie : ties) {
      const double far = tie.distance() / (kCauchy * scale_mm);
      const double weight = 1.0 / ((1.0 + far * far) * scale_mm * scale_mm);
      const Eigen::Vector3d arm = (tie.moved - centre_) / size_mm_;
      const Eigen::Matrix<double, 3, 6> jacobian = smallMotionJacobian(arm);
      if (tie.normal.isZero()) {
        matrix_ += weight * jacobian.transpose() * jacobian;
        right_ += weight * jacobian.transpose() * (tie.target - tie.moved);
      } else {
        const SmallMotion row = jacobian.transpose() * tie.normal;
        matrix_ += weight * row * row.transpose();
        right_ += weight * tie.normal.dot(tie.target - tie.moved) * row;
      }
    }
  }

  // The step in the fixed frame, and its length in mm; nothing when a direction stays open.
  std::optional<std::pair<Rigid3, double>> solve() const {
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(matrix_);
    if (!(eigen.eigenvalues()[0] > 1e-9 * eigen.eigenvalues()[5])) return std::nullopt;
    const SmallMotion motion = matrix_.ldlt().solve(right_);
    return std::pair{rigidOf(motion, centre_, size_mm_), motion.norm()};
  }

 private:
  Eigen::Vector3d centre_;
  double size_mm_;
  Matrix6 matrix_ = Matrix6::Zero();
  SmallMotion right_ = SmallMotion::Zero();
};

// Two surfaces and the search for the motion between them.
class Fitting {
 public:
  Fitting(const MeasuredSurface& fixed, const MeasuredSurface& moving,
          std::span<const PlacePair> pairs)
      : fixed_(fixed),
        moving_(moving),
        pairs_(pairs),
        fixed_index_(fixed.mesh),
        moving_index_(moving.mesh),
        fixed_points_(sampled(fixed.cloud)),
        moving_points_(sampled(moving.cloud)),
        bounds_(boundsOf(fixed.mesh)) {}

  double sizeMm() const { return bounds_.diagonal(); }

  // One round. Nothing when the motion stays open or hardly anything overlaps.
  std::optional<std::pair<Rigid3, double>> step(const Rigid3& fixed_from_moving,
                                                double reach_mm) const {
    const std::vector<Tie> forward = forwardTies(fixed_from_moving, reach_mm);
    std::vector<Tie> backward =
        tiesOf(fixed_points_, moving_index_, moving_.mesh, fixed_from_moving.inverse(), reach_mm);
    for (Tie& tie : backward) {  // the moving surface's place goes to the fixed point
      const Eigen::Vector3d on_moving = fixed_from_moving * tie.target;
      tie.target = fixed_from_moving * tie.moved;
      tie.moved = on_moving;
      tie.normal = fixed_from_moving.rotation * tie.normal;
    }
    if (forward.size() + backward.size() < kLeastTies) return std::nullopt;
    std::vector<Tie> spots;
    for (const PlacePair& pair : pairs_) {
      spots.push_back({fixed_from_moving * pair.moving, pair.fixed});
    }
    const double floor_mm = 1e-6 * sizeMm();
    Equations equations(0.5 * (bounds_.min + bounds_.max), sizeMm());
    equations.add(forward, floor_mm);
    equations.add(backward, floor_mm);
    equations.add(spots, floor_mm);
    return equations.solve();
  }

  std::vector<Tie> forwardTies(const Rigid3& fixed_from_moving, double reach_mm) const {
    return tiesOf(moving_points_, fixed_index_, fixed_.mesh, fixed_from_moving, reach_mm);
  }

  // So far apart surfaces that overlap may lie: the closer they agree, the less.
  double reachMm(const Rigid3& fixed_from_moving, double before_mm) const {
    const double scale_mm = scaleOf(forwardTies(fixed_from_moving, before_mm));
    return std::clamp(kReachScales * scale_mm, kLeastReachShare * sizeMm(), before_mm);
  }

  double overlap(std::size_t ties) const {
    return static_cast<double>(ties) / static_cast<double>(moving_points_.size());
  }

 private:
  const MeasuredSurface& fixed_;
  const MeasuredSurface& moving_;
  std::span<const PlacePair> pairs_;
  SurfaceIndex fixed_index_;
  SurfaceIndex moving_index_;
  std::vector<Point> fixed_points_;
  std::vector<Point> moving_points_;
  Bounds bounds_;
};

}  // namespace

Result<SurfaceFit> fitSurfaces(const MeasuredSurface& fixed, const MeasuredSurface& moving,
                               std::span<const PlacePair> pairs, const Rigid3& start,
                               const Task& task) {
  const Error open{Error::Code::kTooFew, "The two surfaces do not say how they lie on each other.",
                   "Lay the object so that a good part of what one pass sees is seen by the other, "
                   "too: on its side rather than upside down, say."};
  if (fixed.mesh.triangles.empty() || moving.mesh.triangles.empty()) return open;
  if (fixed.cloud.points.empty() || moving.cloud.points.empty()) return open;
  const Fitting fitting(fixed, moving, pairs);
  SurfaceFit fit;
  fit.fixed_from_moving = start;
  double reach_mm = kReachShare * fitting.sizeMm();
  for (int round = 0; round < kMostRounds; ++round) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(round) / kMostRounds, "Fitting the surfaces");
    const auto step = fitting.step(fit.fixed_from_moving, reach_mm);
    if (!step) return open;
    fit.fixed_from_moving = step->first * fit.fixed_from_moving;
    const double before_mm = reach_mm;
    reach_mm = fitting.reachMm(fit.fixed_from_moving, reach_mm);
    const bool settled = reach_mm > 0.98 * before_mm;
    if (settled && step->second < kConverged * fitting.sizeMm()) break;
  }
  const std::vector<Tie> ties = fitting.forwardTies(fit.fixed_from_moving, reach_mm);
  fit.overlap = fitting.overlap(ties.size());
  fit.residual_mm = scaleOf(ties) / kGaussian;
  return fit;
}

}  // namespace gyre
