// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/common_motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/base/random.h"

namespace gyre {
namespace {

constexpr int kGuesses = 80;  // with half of all motions astray, one pair in four is good
constexpr int kRefinements = 5;
constexpr double kParallaxShare = 1.0 / 3.0;
constexpr std::size_t kLeast = 4;
constexpr double kLeastDistance_px = 20.0;  // of the two places that a guess is made from
constexpr double kTrim_sigma = 3.5;

using Row = Eigen::Matrix<double, 2, 4>;

Row rowAt(const Eigen::Vector2d& place) {
  Row row;
  row << 1.0, 0.0, place.x(), -place.y(), 0.0, 1.0, place.y(), place.x();
  return row;
}

SharedMotion motionOf(const Eigen::Vector4d& parameters) {
  SharedMotion motion;
  motion.shift_px = parameters.head<2>();
  motion.stretch = parameters[2];
  motion.turn_rad = parameters[3];
  return motion;
}

std::vector<bool> whoShares(const std::vector<ImageMotion>& motions, const SharedMotion& motion,
                            double tolerance_px) {
  std::vector<bool> shares(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Eigen::Vector2d expected = motion.at(motions[i].place);
    const double limit = std::max(tolerance_px, kParallaxShare * expected.norm());
    shares[i] = (motions[i].moved - expected).norm() <= limit;
  }
  return shares;
}

std::size_t countOf(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

// The guess that the most motions share: first that of two of them, again and again.
std::vector<bool> largestParty(const std::vector<ImageMotion>& motions, double tolerance_px) {
  Random random(motions.size());
  std::vector<bool> best;
  std::size_t most = 0;
  for (int guess = 0; guess < kGuesses; ++guess) {
    const ImageMotion& a = motions[random.below(motions.size())];
    const ImageMotion& b = motions[random.below(motions.size())];
    if ((a.place - b.place).norm() < kLeastDistance_px) continue;
    Eigen::Matrix4d both;
    both << rowAt(a.place), rowAt(b.place);
    Eigen::Vector4d moved;
    moved << a.moved, b.moved;
    const SharedMotion motion = motionOf(both.fullPivLu().solve(moved));
    std::vector<bool> shares = whoShares(motions, motion, tolerance_px);
    if (const std::size_t count = countOf(shares); count > most) {
      most = count;
      best = std::move(shares);
    }
  }
  return best;
}

// Least squares over those who share it, with the covariance that their scatter gives.
std::optional<SharedMotion> fitted(const std::vector<ImageMotion>& motions,
                                   const std::vector<bool>& shares) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!shares[i]) continue;
    const Row row = rowAt(motions[i].place);
    normal += row.transpose() * row;
    right += row.transpose() * motions[i].moved;
    ++count;
  }
  const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
  if (count < kLeast || solver.rcond() < 1e-12) return std::nullopt;
  SharedMotion motion = motionOf(solver.solve(right));
  double squares = 0.0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (shares[i]) squares += (motions[i].moved - motion.at(motions[i].place)).squaredNorm();
  }
  const double variance = squares / static_cast<double>(2 * count - 4);
  motion.covariance = variance * solver.solve(Eigen::Matrix4d::Identity());
  motion.shares = shares;
  motion.sharing = count;
  return motion;
}

// Three robust standard deviations of those who share it are enough: the rest moves otherwise.
std::vector<bool> trimmed(const std::vector<ImageMotion>& motions, const SharedMotion& motion,
                          double tolerance_px) {
  std::vector<bool> shares = whoShares(motions, motion, tolerance_px);
  std::vector<double> misses;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (shares[i]) misses.push_back((motions[i].moved - motion.at(motions[i].place)).norm());
  }
  if (misses.size() < kLeast) return shares;
  const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
  std::nth_element(misses.begin(), middle, misses.end());
  // The median length of a two-dimensional normal error is 1.18 sigma.
  const double limit = std::max(kTrim_sigma * *middle / 1.18, 0.1 * tolerance_px);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    shares[i] = shares[i] && (motions[i].moved - motion.at(motions[i].place)).norm() <= limit;
  }
  return shares;
}

// Mean of x^2 + y^2 over a picture about its middle.
double spreadOf(const Eigen::Vector2d& size_px) { return size_px.squaredNorm() / 12.0; }

}  // namespace

double SharedMotion::rmsPx(const Eigen::Vector2d& picture_size_px) const {
  return std::sqrt(shift_px.squaredNorm() +
                   (stretch * stretch + turn_rad * turn_rad) * spreadOf(picture_size_px));
}

double SharedMotion::rmsSigmaPx(const Eigen::Vector2d& picture_size_px) const {
  return std::sqrt(covariance(0, 0) + covariance(1, 1) +
                   (covariance(2, 2) + covariance(3, 3)) * spreadOf(picture_size_px));
}

std::optional<SharedMotion> sharedMotion(const std::vector<ImageMotion>& motions,
                                         double tolerance_px) {
  if (motions.size() < kLeast) return std::nullopt;
  std::vector<bool> shares = largestParty(motions, tolerance_px);
  if (shares.empty()) return std::nullopt;
  std::optional<SharedMotion> motion = fitted(motions, shares);
  for (int i = 0; i < kRefinements && motion; ++i) {
    std::vector<bool> again = trimmed(motions, *motion, tolerance_px);
    if (again == motion->shares) break;
    motion = fitted(motions, again);
  }
  if (!motion) return std::nullopt;
  // Who shares it is asked with the full tolerance: the fit alone was to be sharp.
  motion->shares = whoShares(motions, *motion, tolerance_px);
  motion->sharing = countOf(motion->shares);
  return motion;
}

}  // namespace gyre
