// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/point_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/recover/ray_intersection.h"
#include "core/recover/reprojection.h"

namespace gyre {
namespace {

constexpr int kHypotheses = 40;
constexpr int kMostJudges = 24;         // sightings that judge a hypothesis
constexpr std::size_t kFinalists = 8;   // hypotheses that all sightings judge
constexpr double kCauchyScale = 2.385;  // 95 % efficiency on Gaussian noise
constexpr int kRobustSteps = 6;
constexpr int kPlainSteps = 3;

// One sighting's part in the normal equations, at a position.
struct Linearized {
  Reprojection at;
  Eigen::Matrix2d information;  // inverse covariance of the sighting
  double chi2 = 0.0;            // residual in standard deviations, squared
};

class Problem {
 public:
  Problem(std::span<const Sighting> sightings, std::span<const Rigid3> poses,
          std::span<const double> angle_variances)
      : sightings_(sightings), poses_(poses), angle_variances_(angle_variances) {}

  std::size_t size() const { return sightings_.size(); }
  const Rigid3& pose(std::size_t i) const {
    return poses_[static_cast<std::size_t>(sightings_[i].view)];
  }

  Ray ray(std::size_t i) const { return rayThrough(pose(i), sightings_[i].normalized); }
  std::vector<Ray> rays() const {
    std::vector<Ray> all;
    all.reserve(size());
    for (std::size_t i = 0; i < size(); ++i) all.push_back(ray(i));
    return all;
  }

  // Nothing when the position is not in front of that camera.
  std::optional<Linearized> linearize(std::size_t i, const Eigen::Vector3d& x) const {
    const auto at = reproject(pose(i), sightings_[i].normalized, x);
    if (!at) return std::nullopt;
    // S = sigma^2 I + sigma_a^2 j j^T with j = d(projected) / d(angle); its inverse by Sherman and
    // Morrison.
    const Eigen::Vector2d& j = at->by_angle;
    const double weight = 1.0 / (sightings_[i].sigma * sightings_[i].sigma);
    const double loosened = weight * angle_variances_[static_cast<std::size_t>(sightings_[i].view)];
    const double share = loosened / (1.0 + loosened * j.squaredNorm());
    const Eigen::Matrix2d information =
        weight * (Eigen::Matrix2d::Identity() - share * j * j.transpose());
    return Linearized{*at, information, at->residual.dot(information * at->residual)};
  }

  // The same chi2 alone; infinite when the position is not in front of that camera.
  double chi2(std::size_t i, const Eigen::Vector3d& x) const {
    const auto miss = missOf(pose(i), sightings_[i].normalized, x);
    if (!miss) return std::numeric_limits<double>::infinity();
    const double variance = sightings_[i].sigma * sightings_[i].sigma;
    const double angle_variance = angle_variances_[static_cast<std::size_t>(sightings_[i].view)];
    const double along = miss->by_angle.dot(miss->residual);
    const double share =
        angle_variance / (variance + angle_variance * miss->by_angle.squaredNorm());
    return (miss->residual.squaredNorm() - share * along * along) / variance;
  }

 private:
  std::span<const Sighting> sightings_;
  std::span<const Rigid3> poses_;
  std::span<const double> angle_variances_;  // rad^2
};

double cauchyWeight(double chi2) { return 1.0 / (1.0 + chi2 / (kCauchyScale * kCauchyScale)); }

struct Normal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

// Sums the normal equations over the sightings; weight(i, chi2) may be zero.
template <class Weight>
std::optional<Normal> buildNormal(const Problem& problem, const Eigen::Vector3d& x,
                                  const Weight& weight) {
  Normal normal;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const auto linear = problem.linearize(i, x);
    if (!linear) return std::nullopt;
    const double w = weight(i, linear->chi2);
    if (w == 0.0) continue;
    const Reprojection& at = linear->at;
    const Eigen::Matrix<double, 3, 2> jw = w * at.by_position.transpose() * linear->information;
    normal.hessian.noalias() += jw * at.by_position;
    normal.gradient.noalias() += jw * at.residual;
  }
  return normal;
}

template <class Weight>
bool gaussNewton(const Problem& problem, int steps, const Weight& weight, Eigen::Vector3d& x) {
  for (int step = 0; step < steps; ++step) {
    const auto normal = buildNormal(problem, x, weight);
    if (!normal) return false;
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal->hessian);
    if (!(solver.vectorD().minCoeff() > 0.0)) return false;
    const Eigen::Vector3d move = solver.solve(normal->gradient);
    if (!move.allFinite()) return false;
    x += move;
    if (move.squaredNorm() < 1e-16 * (1.0 + x.squaredNorm())) break;
  }
  return true;
}

// What a position costs by some sightings: residuals, truncated at four standard deviations.
double truncatedCost(const Problem& problem, std::span<const std::size_t> judges,
                     const Eigen::Vector3d& x) {
  constexpr double kTruncation = 16.0;
  double cost = 0.0;
  for (const std::size_t i : judges) cost += std::min(kTruncation, problem.chi2(i, x));
  return cost;
}

struct Hypothesis {
  double cost = 0.0;
  Eigen::Vector3d position;
};

// Many two-view intersections, each judged by these sightings.
std::vector<Hypothesis> drawHypotheses(const Problem& problem, double min_parallax_rad,
                                       std::span<const std::size_t> judges, Random& random) {
  const std::size_t n = problem.size();
  const std::vector<Ray> rays = problem.rays();
  const std::size_t min_gap = n >= 8 ? n / 4 : 1;
  std::vector<Hypothesis> hypotheses;
  hypotheses.reserve(kHypotheses);
  const auto try_pair = [&](std::size_t a, std::size_t b) {
    const auto x = intersectTwoRays(rays[a], rays[b], min_parallax_rad / 4.0);
    if (x) hypotheses.push_back({truncatedCost(problem, judges, *x), *x});
  };
  if (n * (n - 1) / 2 <= kHypotheses) {
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b) try_pair(a, b);
    }
  } else {
    for (int i = 0; i < kHypotheses; ++i) {
      const std::size_t a = random.below(n - min_gap);
      try_pair(a, a + min_gap + random.below(n - a - min_gap));
    }
  }
  return hypotheses;
}

// The best of the hypotheses. Of a long track a few sightings judge them all and every sighting
// judges the best of these: a draw of judges may happen to hold more wrong than right ones.
std::optional<Eigen::Vector3d> bestHypothesis(const Problem& problem, double min_parallax_rad,
                                              Random& random) {
  const std::size_t n = problem.size();
  std::vector<std::size_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = i;
  std::vector<std::size_t> judges = all;
  if (n > kMostJudges) {
    for (std::size_t i = 0; i < kMostJudges; ++i) {
      std::swap(judges[i], judges[i + random.below(n - i)]);
    }
    judges.resize(kMostJudges);
  }
  std::vector<Hypothesis> best = drawHypotheses(problem, min_parallax_rad, judges, random);
  if (best.empty()) return std::nullopt;
  const auto cheaper = [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; };
  if (n > kMostJudges && best.size() > kFinalists) {
    std::nth_element(best.begin(), best.begin() + kFinalists, best.end(), cheaper);
    best.resize(kFinalists);
  }
  if (n > kMostJudges) {
    for (Hypothesis& each : best) each.cost = truncatedCost(problem, all, each.position);
  }
  return std::min_element(best.begin(), best.end(), cheaper)->position;
}

// Fills what is reported of a position whose covariance is known.
void judge(const Problem& problem, double outlier_sigma, EstimatedPoint& point) {
  const double limit = outlier_sigma * outlier_sigma;
  point.agrees.assign(problem.size(), 0);
  point.agreeing = 0;
  double chi2_sum = 0.0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const double chi2 = problem.chi2(i, point.position_in_table);
    if (chi2 > limit) continue;
    point.agrees[i] = 1;
    ++point.agreeing;
    chi2_sum += chi2;
  }
  point.chi2_per_freedom = chi2_sum / std::max(1, 2 * point.agreeing - 3);
}

double agreeingParallax(const Problem& problem, const EstimatedPoint& point) {
  std::vector<Ray> rays;
  rays.reserve(problem.size());
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (point.agrees[i] != 0) rays.push_back(problem.ray(i));
  }
  return widestAngle(rays);
}

// Covariance from the inverse Hessian, widened when the residuals are larger than their sigma.
template <class Weight>
bool fillCovariance(const Problem& problem, const Weight& weight, EstimatedPoint& point) {
  const auto normal = buildNormal(problem, point.position_in_table, weight);
  if (!normal) return false;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal->hessian);
  if (!(solver.vectorD().minCoeff() > 0.0)) return false;
  point.covariance =
      std::max(1.0, point.chi2_per_freedom) * solver.solve(Eigen::Matrix3d::Identity());
  return point.covariance.allFinite();
}

// From a start nearby: Cauchy weights, then plainly those that agree.
std::optional<EstimatedPoint> settle(const Problem& problem, const RecoverOptions& options,
                                     const Eigen::Vector3d& start) {
  const double least_agreeing =
      std::max(static_cast<double>(options.min_views),
               options.min_agreeing * static_cast<double>(problem.size()));
  EstimatedPoint point;
  point.position_in_table = start;
  const auto cauchy = [](std::size_t, double chi2) { return cauchyWeight(chi2); };
  if (!gaussNewton(problem, kRobustSteps, cauchy, point.position_in_table)) return std::nullopt;
  const auto agreeing = [&](std::size_t i, double) { return point.agrees[i] != 0 ? 1.0 : 0.0; };
  for (int round = 0; round < 2; ++round) {
    judge(problem, options.outlier_sigma, point);
    if (point.agreeing < least_agreeing) return std::nullopt;
    if (!gaussNewton(problem, kPlainSteps, agreeing, point.position_in_table)) return std::nullopt;
  }
  judge(problem, options.outlier_sigma, point);
  if (point.agreeing < least_agreeing) return std::nullopt;
  point.parallax_rad = agreeingParallax(problem, point);
  if (point.parallax_rad < radFromDeg(options.min_parallax_deg)) return std::nullopt;
  if (!fillCovariance(problem, agreeing, point)) return std::nullopt;
  return point;
}

// The paper's readings: no sighting is doubted.
std::optional<EstimatedPoint> estimateByPaper(Solver solver, const Problem& problem,
                                              double min_parallax_rad) {
  const std::vector<Ray> rays = problem.rays();
  EstimatedPoint point;
  point.parallax_rad = widestAngle(rays);
  if (point.parallax_rad < min_parallax_rad) return std::nullopt;
  const auto position = intersectByPaper(solver, rays);
  if (!position) return std::nullopt;
  point.position_in_table = *position;
  judge(problem, std::numeric_limits<double>::max(), point);
  if (point.agreeing < static_cast<int>(problem.size())) return std::nullopt;  // behind a camera
  const auto believed = [](std::size_t, double) { return 1.0; };
  if (!fillCovariance(problem, believed, point)) return std::nullopt;
  return point;
}

}  // namespace

Result<PointEstimator> PointEstimator::create(const RecoverOptions& options) {
  if (auto valid = options.validate(); !valid) return valid.error();
  return PointEstimator(options, *solverFromName(options.solver));
}

void PointEstimator::addPose(const Rigid3& cam_from_table) {
  addPose(cam_from_table, radFromDeg(options_.angle_sigma_deg));
}

void PointEstimator::addPose(const Rigid3& cam_from_table, double angle_sigma_rad) {
  poses_.push_back(cam_from_table);
  angle_variances_.push_back(angle_sigma_rad * angle_sigma_rad);
}

std::optional<EstimatedPoint> PointEstimator::estimate(std::span<const Sighting> sightings,
                                                       std::uint64_t seed) const {
  const auto n = static_cast<int>(sightings.size());
  if (n < options_.min_views) return std::nullopt;
  const Problem problem(sightings, poses_, angle_variances_);
  Random random(seed);
  const double min_parallax_rad = radFromDeg(options_.min_parallax_deg);
  if (solver_ != Solver::kRobust) return estimateByPaper(solver_, problem, min_parallax_rad);
  auto start = bestHypothesis(problem, min_parallax_rad, random);
  if (!start) return std::nullopt;

  return settle(problem, options_, *start);
}

std::optional<EstimatedPoint> PointEstimator::estimateFrom(
    std::span<const Sighting> sightings, const Eigen::Vector3d& position_in_table) const {
  if (solver_ != Solver::kRobust) return estimate(sightings, 0);
  if (static_cast<int>(sightings.size()) < options_.min_views) return std::nullopt;
  return settle(Problem(sightings, poses_, angle_variances_), options_, position_in_table);
}

std::optional<EstimatedPoint> PointEstimator::refine(
    std::span<const Sighting> sightings, const Eigen::Vector3d& position_in_table) const {
  const Problem problem(sightings, poses_, angle_variances_);
  EstimatedPoint point;
  point.position_in_table = position_in_table;
  const auto cauchy = [](std::size_t, double chi2) { return cauchyWeight(chi2); };
  if (!gaussNewton(problem, 2, cauchy, point.position_in_table)) return std::nullopt;
  judge(problem, options_.outlier_sigma, point);
  point.parallax_rad = agreeingParallax(problem, point);
  if (!fillCovariance(problem, cauchy, point)) return std::nullopt;
  return point;
}

}  // namespace gyre
