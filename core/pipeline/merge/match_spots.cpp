// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/match_spots.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <opencv2/features2d.hpp>

#include "core/base/random.h"
#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kNeighbours = 8;  // the same place comes from several pictures
constexpr float kClearlyNearer = 0.85F;
constexpr int kTries = 200000;      // of threes; most fail at their sides' lengths
constexpr int kMostCounted = 4000;  // of threes that do not
constexpr std::size_t kLeastAgreeing = 20;
constexpr int kPolishes = 4;
constexpr double kLeastSpread = 0.05;  // across the line that places lie along, of their length

struct Fitted {
  Rigid3 fixed_from_moving;
  bool determined = false;
};

// Least squares over the pairs of these numbers. Umeyama (1991), without scale.
Fitted motionOf(std::span<const SpotPair> pairs, std::span<const std::size_t> chosen) {
  Eigen::Matrix3Xd fixed(3, static_cast<Eigen::Index>(chosen.size()));
  Eigen::Matrix3Xd moving = fixed;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    fixed.col(static_cast<Eigen::Index>(i)) = pairs[chosen[i]].fixed;
    moving.col(static_cast<Eigen::Index>(i)) = pairs[chosen[i]].moving;
  }
  const Eigen::Matrix3Xd centred = fixed.colwise() - fixed.rowwise().mean().eval();
  const Eigen::Vector3d spread = Eigen::JacobiSVD<Eigen::Matrix3Xd>(centred).singularValues();
  Fitted fitted;
  if (!(spread[1] > kLeastSpread * spread[0])) return fitted;
  const Eigen::Matrix4d motion = Eigen::umeyama(moving, fixed, false);
  fitted.fixed_from_moving.rotation = motion.topLeftCorner<3, 3>();
  fitted.fixed_from_moving.translation = motion.topRightCorner<3, 1>();
  fitted.determined = isRigid(fitted.fixed_from_moving);
  return fitted;
}

std::vector<std::size_t> agreeingWith(const Rigid3& fixed_from_moving,
                                      std::span<const SpotPair> pairs, double tolerance_mm) {
  static const double kLeastCosine = std::cos(radFromDeg(45.0));
  std::vector<std::size_t> agreeing;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const SpotPair& pair = pairs[i];
    if ((fixed_from_moving * pair.moving - pair.fixed).squaredNorm() > tolerance_mm * tolerance_mm)
      continue;
    const double cosine = (fixed_from_moving.rotation * pair.moving_normal).dot(pair.fixed_normal);
    if (cosine >= kLeastCosine) agreeing.push_back(i);
  }
  return agreeing;
}

// Whether three pairs can be one motion at all, and say which.
bool mayBeOneMotion(std::span<const SpotPair> pairs, const std::array<std::size_t, 3>& three,
                    double tolerance_mm) {
  for (std::size_t i = 0; i < 3; ++i) {
    const SpotPair& a = pairs[three[i]];
    const SpotPair& b = pairs[three[(i + 1) % 3]];
    const double fixed_mm = (a.fixed - b.fixed).norm();
    if (fixed_mm < 8.0 * tolerance_mm) return false;
    if (std::abs(fixed_mm - (a.moving - b.moving).norm()) > 2.0 * tolerance_mm) return false;
  }
  return true;
}

}  // namespace

std::vector<SpotPair> pairSpots(const SurfaceSpots& fixed, const SurfaceSpots& moving,
                                double apart_mm) {
  std::vector<SpotPair> pairs;
  if (fixed.places.size() < 2 || moving.places.empty()) return pairs;
  std::vector<std::vector<cv::DMatch>> found;
  const int neighbours = std::min(kNeighbours, static_cast<int>(fixed.places.size()));
  cv::BFMatcher(cv::NORM_L2).knnMatch(moving.descriptors, fixed.descriptors, found, neighbours);
  for (const auto& candidates : found) {
    if (candidates.empty()) continue;
    const auto best = static_cast<std::size_t>(candidates.front().trainIdx);
    bool clear = true;
    for (const cv::DMatch& other : candidates) {
      const auto place = static_cast<std::size_t>(other.trainIdx);
      if ((fixed.places[place] - fixed.places[best]).norm() <= apart_mm) continue;
      clear = candidates.front().distance < kClearlyNearer * other.distance;
      break;
    }
    if (!clear) continue;
    const auto from = static_cast<std::size_t>(candidates.front().queryIdx);
    pairs.push_back(
        {fixed.places[best], moving.places[from], fixed.normals[best], moving.normals[from]});
  }
  return pairs;
}

std::optional<SpotAgreement> agreeingMotion(std::span<const SpotPair> pairs, double tolerance_mm,
                                            const Task& task) {
  if (pairs.size() < kLeastAgreeing) return std::nullopt;
  Random random(hashWords({pairs.size(), 71}));
  std::vector<std::size_t> best;
  int counted = 0;
  for (int i = 0; i < kTries && counted < kMostCounted && !task.stopRequested(); ++i) {
    const std::array<std::size_t, 3> three = {
        random.below(pairs.size()), random.below(pairs.size()), random.below(pairs.size())};
    if (!mayBeOneMotion(pairs, three, tolerance_mm)) continue;
    const Fitted fitted = motionOf(pairs, three);
    if (!fitted.determined) continue;
    ++counted;
    std::vector<std::size_t> agreeing = agreeingWith(fitted.fixed_from_moving, pairs, tolerance_mm);
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  Fitted fitted;
  for (int i = 0; i < kPolishes; ++i) {
    if (best.size() < kLeastAgreeing || task.stopRequested()) return std::nullopt;
    fitted = motionOf(pairs, best);
    if (!fitted.determined) return std::nullopt;
    best = agreeingWith(fitted.fixed_from_moving, pairs, tolerance_mm);
  }
  if (best.size() < kLeastAgreeing) return std::nullopt;
  SpotAgreement agreement{fitted.fixed_from_moving, {}};
  for (const std::size_t i : best) agreement.pairs.push_back(pairs[i]);
  return agreement;
}

}  // namespace gyre
