// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/axis_from_poses.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kReweightings = 8;
constexpr double kLeastScale = 1e-9;

struct Motion {
  Eigen::Matrix3d turn;   // R
  Eigen::Vector3d shift;  // t
};

std::vector<Motion> motionsOf(const std::vector<PoseSeries>& pieces, double min_turn_rad) {
  std::vector<Motion> motions;
  for (const PoseSeries& poses : pieces) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t j = i + 1; j < poses.size() && poses[i]; ++j) {
        if (!poses[j]) continue;
        const Rigid3 motion = *poses[j] * poses[i]->inverse();
        if (Eigen::AngleAxisd(motion.rotation).angle() < min_turn_rad) continue;
        motions.push_back({motion.rotation, motion.translation});
      }
    }
  }
  return motions;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Cauchy weights from the residuals' own median.
std::vector<double> weightsFor(const std::vector<double>& residuals) {
  const double scale = std::max(2.0 * median(residuals), kLeastScale);
  std::vector<double> weights;
  weights.reserve(residuals.size());
  for (const double residual : residuals) {
    weights.push_back(1.0 / (1.0 + residual * residual / (scale * scale)));
  }
  return weights;
}

Eigen::Vector3d directionOf(const std::vector<Motion>& motions) {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  std::vector<double> weights(motions.size(), 1.0);
  for (int iteration = 0; iteration < kReweightings; ++iteration) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const Eigen::Matrix3d d = motions[i].turn - Eigen::Matrix3d::Identity();
      sum += weights[i] * d.transpose() * d;
    }
    direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
    std::vector<double> residuals;
    residuals.reserve(motions.size());
    for (const Motion& motion : motions) {
      residuals.push_back((motion.turn * direction - direction).norm());
    }
    weights = weightsFor(residuals);
  }
  return direction;
}

Eigen::Vector3d pointOn(const Eigen::Vector3d& direction, const std::vector<Motion>& motions) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::vector<double> weights(motions.size(), 1.0);
  for (int iteration = 0; iteration < kReweightings; ++iteration) {
    Eigen::Matrix3d normal = direction * direction.transpose();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const Eigen::Matrix3d d = Eigen::Matrix3d::Identity() - motions[i].turn;
      normal += weights[i] * d.transpose() * d;
      right += weights[i] * d.transpose() * motions[i].shift;
    }
    point = normal.ldlt().solve(right);
    std::vector<double> residuals;
    residuals.reserve(motions.size());
    for (const Motion& motion : motions) {
      residuals.push_back((point - motion.turn * point - motion.shift).norm());
    }
    weights = weightsFor(residuals);
  }
  return point;
}

// The rotation's part about the axis.
double turnAbout(const Eigen::Vector3d& axis, const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return wrapped(2.0 * std::atan2(q.vec().dot(axis), q.w()));
}

double circularMedian(const std::vector<double>& angles_rad) {
  const auto cost = [&](double middle) {
    double sum = 0.0;
    for (const double angle : angles_rad) sum += std::abs(wrapped(angle - middle));
    return sum;
  };
  return *std::min_element(angles_rad.begin(), angles_rad.end(),
                           [&](double a, double b) { return cost(a) < cost(b); });
}

}  // namespace

double wrapped(double angle_rad) {
  const double in_turn = std::remainder(angle_rad, kTurn_rad);
  return in_turn <= -kPi ? in_turn + kTurn_rad : in_turn;
}

std::optional<AxisInCam> axisFromPoses(const std::vector<PoseSeries>& pieces, double min_turn_rad) {
  const std::vector<Motion> motions = motionsOf(pieces, min_turn_rad);
  if (motions.empty()) return std::nullopt;
  AxisInCam axis;
  axis.direction = directionOf(motions);
  axis.point = pointOn(axis.direction, motions);
  return axis;
}

std::vector<std::optional<double>> anglesFromPoses(const std::vector<PoseSeries>& pieces,
                                                   const Eigen::Vector3d& axis_in_cam) {
  const std::size_t views = pieces.empty() ? 0 : pieces.front().size();
  std::vector<std::optional<double>> angles(views);
  std::vector<bool> used(pieces.size(), false);
  for (std::size_t round = 0; round < pieces.size(); ++round) {
    // The piece that shares most pictures with those already known; at first the one seen most.
    std::size_t best = pieces.size();
    std::size_t best_shared = 0;
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
      if (used[piece]) continue;
      std::size_t shared = 0;
      for (std::size_t k = 0; k < views; ++k)
        shared += pieces[piece][k] && (round == 0 || angles[k]);
      if (shared > best_shared) {
        best = piece;
        best_shared = shared;
      }
    }
    if (best == pieces.size()) break;
    used[best] = true;
    const PoseSeries& poses = pieces[best];
    const auto first = std::find_if(poses.begin(), poses.end(), [](const auto& p) { return !!p; });
    std::vector<std::optional<double>> own(views);
    std::vector<double> offsets;
    for (std::size_t k = 0; k < views; ++k) {
      if (!poses[k]) continue;
      own[k] = turnAbout(axis_in_cam, poses[k]->rotation * (*first)->rotation.transpose());
      if (angles[k]) offsets.push_back(wrapped(*angles[k] - *own[k]));
    }
    const double offset = offsets.empty() ? 0.0 : circularMedian(offsets);
    for (std::size_t k = 0; k < views; ++k) {
      if (own[k] && !angles[k]) angles[k] = wrapped(*own[k] + offset);
    }
  }
  const auto zero = std::find_if(angles.begin(), angles.end(), [](const auto& a) { return !!a; });
  if (zero == angles.end()) return angles;
  const double zero_rad = **zero;
  for (auto& angle : angles) {
    if (angle) angle = wrapped(*angle - zero_rad);
  }
  return angles;
}

}  // namespace gyre
