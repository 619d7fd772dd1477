// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/joint_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/reprojection.h"

namespace gyre {
namespace {

// Tracks are summed in so many parts, whatever the machine: each holds a matrix of views by views.
constexpr std::size_t kParts = 8;
// Below this share of its largest pivot a point's smallest says that the rays are parallel.
constexpr double kSingular = 1e-9;
constexpr double kLeastGain = 1e-9;  // of the cost: smaller steps end the search
constexpr double kMostDamping = 1e6;

// One sighting's angle in the normal equations of its track.
struct AngleRow {
  Eigen::Index view = 0;
  double information = 0.0;  // of the angle alone
  double gradient = 0.0;
  Eigen::Vector3d coupling = Eigen::Vector3d::Zero();  // of the angle with the point
};

// One track's part: the point's own block, and a row a sighting.
struct TrackBlocks {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  std::vector<AngleRow> rows;
  double cost = 0.0;
  double chi2 = 0.0;
};

struct State {
  std::vector<double> corrections_rad;
  std::vector<Eigen::Vector3d> positions;
};

// The normal equations of the angles, the points eliminated.
struct Reduced {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
};

class JointProblem {
 public:
  JointProblem(std::span<const JointTrack> tracks, std::span<const Rigid3> cam_from_table,
               const AnglePrior& prior, const JointAnglesOptions& options)
      : tracks_(tracks),
        told_(cam_from_table),
        prior_sigma_(prior.sigma_rad),
        prior_information_(informationOf(prior)),
        scale_squared_(options.cauchy_sigma * options.cauchy_sigma) {}

  std::size_t views() const { return told_.size(); }

  void setState(const State& state);
  double cost(const State& state);
  Reduced reduce(const State& state, double damping) const;
  State moved(const State& state, const Eigen::VectorXd& turn, double damping) const;
  JointAngles result(const State& state) const;
  // Takes the tracks that say something: their points lie before the cameras, and their rays fix
  // them. Returns how many.
  std::size_t choose(const State& state);

 private:
  bool linearize(std::size_t track, const Eigen::Vector3d& position, TrackBlocks& blocks) const;
  std::optional<Eigen::Matrix3d> inverseOf(const Eigen::Matrix3d& hessian, double damping) const;
  double loss(double chi2) const {
    return std::isinf(scale_squared_) ? chi2 : scale_squared_ * std::log1p(chi2 / scale_squared_);
  }
  template <class Body>
  void forParts(const Body& body) const {
    parallelFor(kParts, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t part = first; part < last; ++part) {
        const std::size_t begin = part * chosen_.size() / kParts;
        const std::size_t end = (part + 1) * chosen_.size() / kParts;
        body(part, std::span(chosen_).subspan(begin, end - begin));
      }
    });
  }

  std::span<const JointTrack> tracks_;
  std::span<const Rigid3> told_;
  std::span<const double> prior_sigma_;
  Eigen::MatrixXd prior_information_;
  double scale_squared_;
  std::vector<Rigid3> poses_;        // at the corrected angles
  std::vector<std::size_t> chosen_;  // indices into the tracks
};

void JointProblem::setState(const State& state) {
  poses_.assign(told_.begin(), told_.end());
  for (std::size_t view = 0; view < views(); ++view) {
    poses_[view] = told_[view] * baseFromTable(state.corrections_rad[view]);
  }
}

// False when the point lies behind a camera.
bool JointProblem::linearize(std::size_t track, const Eigen::Vector3d& position,
                             TrackBlocks& blocks) const {
  blocks.hessian.setZero();
  blocks.gradient.setZero();
  blocks.rows.clear();
  blocks.cost = 0.0;
  blocks.chi2 = 0.0;
  for (const Sighting& sighting : tracks_[track].sightings) {
    const auto at =
        reproject(poses_[static_cast<std::size_t>(sighting.view)], sighting.normalized, position);
    if (!at) return false;
    const double certainty = 1.0 / (sighting.sigma * sighting.sigma);
    const double chi2 = certainty * at->residual.squaredNorm();
    const double weight = certainty / (1.0 + chi2 / scale_squared_);
    const Eigen::Matrix<double, 3, 2> jw = weight * at->by_position.transpose();
    blocks.hessian.noalias() += jw * at->by_position;
    blocks.gradient.noalias() += jw * at->residual;
    blocks.rows.push_back({sighting.view, weight * at->by_angle.squaredNorm(),
                           weight * at->by_angle.dot(at->residual), jw * at->by_angle});
    blocks.cost += loss(chi2);
    blocks.chi2 += weight / certainty * chi2;
  }
  return true;
}

// Nothing when the rays of the track do not fix its point: it then says nothing of the angles.
std::optional<Eigen::Matrix3d> JointProblem::inverseOf(const Eigen::Matrix3d& hessian,
                                                       double damping) const {
  Eigen::Matrix3d damped = hessian;
  damped.diagonal() *= 1.0 + damping;
  const Eigen::LDLT<Eigen::Matrix3d> solver(damped);
  const Eigen::Vector3d pivots = solver.vectorD();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return std::nullopt;
  return solver.solve(Eigen::Matrix3d::Identity());
}

std::size_t JointProblem::choose(const State& state) {
  chosen_.clear();
  TrackBlocks blocks;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (linearize(i, state.positions[i], blocks) && inverseOf(blocks.hessian, 0.0)) {
      chosen_.push_back(i);
    }
  }
  return chosen_.size();
}

double JointProblem::cost(const State& state) {
  setState(state);
  std::vector<double> costs(kParts, 0.0);
  forParts([&](std::size_t part, std::span<const std::size_t> chosen) {
    TrackBlocks blocks;
    for (const std::size_t i : chosen) {
      costs[part] += linearize(i, state.positions[i], blocks)
                         ? blocks.cost
                         : std::numeric_limits<double>::infinity();
    }
  });
  double sum = 0.0;
  for (const double each : costs) sum += each;
  const Eigen::Map<const Eigen::VectorXd> off(state.corrections_rad.data(),
                                              static_cast<Eigen::Index>(views()));
  return sum + off.dot(prior_information_ * off);
}

Reduced JointProblem::reduce(const State& state, double damping) const {
  const auto n = static_cast<Eigen::Index>(views());
  std::vector<Reduced> parts(kParts);
  forParts([&](std::size_t part, std::span<const std::size_t> chosen) {
    Reduced& sum = parts[part];
    sum = {Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    TrackBlocks blocks;
    std::vector<Eigen::Vector3d> carried;
    for (const std::size_t i : chosen) {
      if (!linearize(i, state.positions[i], blocks)) continue;
      const auto inverse = inverseOf(blocks.hessian, damping);
      if (!inverse) continue;
      const Eigen::Vector3d move = *inverse * blocks.gradient;
      carried.resize(blocks.rows.size());
      for (std::size_t a = 0; a < blocks.rows.size(); ++a) {
        const AngleRow& row = blocks.rows[a];
        carried[a] = *inverse * row.coupling;
        sum.information(row.view, row.view) += row.information * (1.0 + damping);
        sum.gradient[row.view] += row.gradient - row.coupling.dot(move);
        for (std::size_t b = 0; b <= a; ++b) {  // views ascend: the lower triangle
          sum.information(row.view, blocks.rows[b].view) -= row.coupling.dot(carried[b]);
        }
      }
    }
  });
  Reduced all = std::move(parts.front());
  for (std::size_t part = 1; part < kParts; ++part) {
    all.information += parts[part].information;
    all.gradient += parts[part].gradient;
  }
  const Eigen::Map<const Eigen::VectorXd> off(state.corrections_rad.data(), n);
  all.information += prior_information_;
  all.gradient -= prior_information_ * off;
  for (Eigen::Index view = 0; view < n; ++view) {
    if (prior_sigma_[static_cast<std::size_t>(view)] > 0.0) continue;
    all.information.row(view).setZero();
    all.information.col(view).setZero();
    all.information(view, view) = 1.0;
    all.gradient[view] = 0.0;
  }
  return all;
}

// The state after the angles turn, and each point with them.
State JointProblem::moved(const State& state, const Eigen::VectorXd& turn, double damping) const {
  State next = state;
  for (std::size_t view = 0; view < views(); ++view) {
    next.corrections_rad[view] += turn[static_cast<Eigen::Index>(view)];
  }
  forParts([&](std::size_t, std::span<const std::size_t> chosen) {
    TrackBlocks blocks;
    for (const std::size_t i : chosen) {
      if (!linearize(i, state.positions[i], blocks)) continue;
      const auto inverse = inverseOf(blocks.hessian, damping);
      if (!inverse) continue;
      Eigen::Vector3d pull = blocks.gradient;
      for (const AngleRow& row : blocks.rows) pull -= row.coupling * turn[row.view];
      next.positions[i] += *inverse * pull;
    }
  });
  return next;
}

JointAngles JointProblem::result(const State& state) const {
  const auto n = static_cast<Eigen::Index>(views());
  JointAngles found;
  found.corrections_rad = state.corrections_rad;
  found.positions_in_table = state.positions;
  Eigen::MatrixXd information = reduce(state, 0.0).information;
  Eigen::MatrixXd covariance =
      information.selfadjointView<Eigen::Lower>().ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  for (Eigen::Index view = 0; view < n; ++view) {
    if (prior_sigma_[static_cast<std::size_t>(view)] > 0.0) continue;
    covariance.row(view).setZero();
    covariance.col(view).setZero();
  }
  // A turn common to all views: c - mean(c) has the covariance P C P, P = I - 1/n.
  const Eigen::VectorXd row_means = covariance.rowwise().mean();
  const double mean = row_means.mean();
  for (Eigen::Index view = 0; view < n; ++view) {
    const double variance = covariance(view, view) - 2.0 * row_means[view] + mean;
    found.sigma_rad.push_back(std::sqrt(std::max(0.0, variance)));
  }
  found.covariances.assign(tracks_.size(), Eigen::Matrix3d::Zero());
  std::vector<double> chi2(kParts, 0.0);
  std::vector<double> freedoms(kParts, 0.0);
  forParts([&](std::size_t part, std::span<const std::size_t> chosen) {
    TrackBlocks blocks;
    for (const std::size_t i : chosen) {
      if (!linearize(i, state.positions[i], blocks)) continue;
      const auto inverse = inverseOf(blocks.hessian, 0.0);
      if (!inverse) continue;
      Eigen::Matrix3d through_angles = Eigen::Matrix3d::Zero();
      for (const AngleRow& a : blocks.rows) {
        Eigen::Vector3d carried = Eigen::Vector3d::Zero();
        for (const AngleRow& b : blocks.rows) carried += covariance(a.view, b.view) * b.coupling;
        through_angles += a.coupling * carried.transpose();
      }
      found.covariances[i] = *inverse + *inverse * through_angles * *inverse;
      chi2[part] += blocks.chi2;
      freedoms[part] += 2.0 * static_cast<double>(blocks.rows.size()) - 3.0;
    }
  });
  double chi2_sum = 0.0;
  double freedom = -static_cast<double>(n);
  for (std::size_t part = 0; part < kParts; ++part) {
    chi2_sum += chi2[part];
    freedom += freedoms[part];
  }
  found.chi2_per_freedom = chi2_sum / std::max(1.0, freedom);
  return found;
}

// Levenberg and Marquardt: a step that does not help is taken back and damped.
Result<void> descend(JointProblem& problem, int most_steps, const Task& task, State& state) {
  double cost = problem.cost(state);
  double damping = 0.0;
  for (int step = 0; step < most_steps && damping < kMostDamping; ++step) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(step) / most_steps, "Solving the table's angles");
    problem.setState(state);
    const Reduced reduced = problem.reduce(state, damping);
    const Eigen::LDLT<Eigen::MatrixXd, Eigen::Lower> solver(reduced.information);
    const Eigen::VectorXd turn = solver.solve(reduced.gradient);
    State next = problem.moved(state, turn, damping);
    const double next_cost = turn.allFinite() ? problem.cost(next) : cost;
    if (!(next_cost < cost)) {
      damping = std::max(1e-4, 10.0 * damping);
      continue;
    }
    const double gain = (cost - next_cost) / cost;
    state = std::move(next);
    cost = next_cost;
    damping = damping < 1e-3 ? 0.0 : 0.1 * damping;
    if (gain < kLeastGain) break;
  }
  problem.setState(state);
  return {};
}

}  // namespace

Result<JointAngles> solveJointAngles(std::span<const JointTrack> tracks,
                                     std::span<const Rigid3> cam_from_table,
                                     const AnglePrior& prior, const JointAnglesOptions& options,
                                     const Task& task) {
  GYRE_CHECK(cam_from_table.size() == prior.sigma_rad.size());
  State state;
  state.corrections_rad.assign(prior.start_rad.begin(), prior.start_rad.end());
  state.corrections_rad.resize(cam_from_table.size(), 0.0);
  state.positions.reserve(tracks.size());
  for (const JointTrack& track : tracks) state.positions.push_back(track.position_in_table);
  JointProblem problem(tracks, cam_from_table, prior, options);
  problem.setState(state);
  if (problem.choose(state) == 0) {
    return Error{Error::Code::kTooFew, "No feature was seen from directions different enough.",
                 "Turn the table further between the first and the last picture."};
  }
  if (auto done = descend(problem, options.most_steps, task, state); !done) return done.error();
  return problem.result(state);
}

}  // namespace gyre
