// The most likely position of a point, given where views saw it, with its covariance.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"
#include "core/recover/options.h"
#include "core/recover/sighting.h"
#include "core/recover/solver.h"

namespace gyre {

struct EstimatedPoint {
  Eigen::Vector3d position_in_table = Eigen::Vector3d::Zero();  // mm
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();         // mm^2
  std::vector<std::uint8_t> agrees;  // one a sighting: 1 when within outlier_sigma
  int agreeing = 0;
  double chi2_per_freedom = 0.0;  // of the agreeing sightings; near 1 when sigma is right
  double parallax_rad = 0.0;      // widest angle between agreeing rays
};

// Estimates points one by one, each independent of all others, as the paper demands.
// Immutable but for the poses; estimate() may run on many threads at once.
class PointEstimator {
 public:
  // Fails when an option is out of its range.
  static Result<PointEstimator> create(const RecoverOptions& options);

  // Sightings name their views by index into these poses. angle_sigma_rad: how far the table's
  // angle of this view may be off; without it, the options' angle_sigma_deg.
  void addPose(const Rigid3& cam_from_table);
  void addPose(const Rigid3& cam_from_table, double angle_sigma_rad);
  const std::vector<Rigid3>& poses() const { return poses_; }

  // By the options' solver. Robust from scratch: two-view hypotheses judged by all sightings
  // (MSAC), Cauchy-weighted and then plain Gauss-Newton on the reprojection error of those that
  // agree. Deterministic in the seed. Returns nothing when the sightings are too few, agree too
  // little, have too little parallax, or the point lies behind a camera: bad tracks are common and
  // are not an error. Leow et al. (2000), eq. 8 and 9; Torr and Zisserman, "MLESAC" (2000).
  std::optional<EstimatedPoint> estimate(std::span<const Sighting> sightings,
                                         std::uint64_t seed) const;

  // The same from a position that is known to be right to some pixels: the sightings are not asked
  // where else the point might be.
  std::optional<EstimatedPoint> estimateFrom(std::span<const Sighting> sightings,
                                             const Eigen::Vector3d& position_in_table) const;

  // Refines a position that is nearly right already, with Cauchy weights: for a live track that
  // has gained a sighting. Returns nothing when the point runs behind a camera.
  std::optional<EstimatedPoint> refine(std::span<const Sighting> sightings,
                                       const Eigen::Vector3d& position_in_table) const;

 private:
  PointEstimator(const RecoverOptions& options, Solver solver)
      : options_(options), solver_(solver) {}

  RecoverOptions options_;
  Solver solver_;
  std::vector<Rigid3> poses_;
  std::vector<double> angle_variances_;  // rad^2, one a pose
};

}  // namespace gyre
