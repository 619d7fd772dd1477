// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/lattice_pose.h"

#include <cmath>

#include <opencv2/calib3d.hpp>

#include "core/calib/corners/plane_homography.h"

namespace gyre {
namespace {

Eigen::Vector2d middleOf(const CornerLattice& lattice) {
  return 0.5 * (lattice.size - Eigen::Vector2i::Ones()).cast<double>();
}

std::optional<Eigen::Matrix3d> homographyOf(const CornerLattice& lattice,
                                            std::span<const XCorner> corners,
                                            const Eigen::Vector2d& origin_px) {
  std::vector<PlaneSighting> sightings;
  for (const LatticeNode& node : lattice.nodes) {
    sightings.push_back({node.cell.cast<double>() - middleOf(lattice),
                         corners[static_cast<std::size_t>(node.corner)].pixel - origin_px});
  }
  return fitHomography(sightings);
}

}  // namespace

std::optional<double> focalFromLattices(std::span<const CornerLattice> lattices,
                                        std::span<const XCorner> corners,
                                        const Eigen::Vector2d& principal_px) {
  // With w = 1 / f^2 and H = (h1 h2 h3) about the principal point:
  //   w (h11 h12 + h21 h22) + h31 h32 = 0,   w (h11^2 + h21^2 - h12^2 - h22^2) + h31^2 - h32^2 = 0.
  double sum_aa = 0.0;
  double sum_ac = 0.0;
  for (const CornerLattice& lattice : lattices) {
    const auto homography = homographyOf(lattice, corners, principal_px);
    if (!homography) continue;
    // Scaled so that a step of one square is about one: all lattices count by their corners.
    const double size = (homographyJacobian(*homography, {0.0, 0.0})).norm() * (*homography)(2, 2);
    const Eigen::Matrix3d h = *homography / size;
    const auto weight = static_cast<double>(lattice.nodes.size());
    const double extent = lattice.size.cast<double>().norm();
    for (const auto& [a, c] :
         {std::pair(h(0, 0) * h(0, 1) + h(1, 0) * h(1, 1), h(2, 0) * h(2, 1)),
          std::pair(0.5 * (h.block<2, 1>(0, 0).squaredNorm() - h.block<2, 1>(0, 1).squaredNorm()),
                    0.5 * (h(2, 0) * h(2, 0) - h(2, 1) * h(2, 1)))}) {
      sum_aa += weight * extent * a * a;
      sum_ac += weight * extent * a * c;
    }
  }
  const double w = sum_aa > 0.0 ? -sum_ac / sum_aa : 0.0;
  if (!(w > 0.0)) return std::nullopt;
  return 1.0 / std::sqrt(w);
}

std::vector<Rigid3> posesOfLattice(const CornerLattice& lattice, std::span<const XCorner> corners,
                                   const CameraModel& camera) {
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> images;
  for (const LatticeNode& node : lattice.nodes) {
    const Eigen::Vector2d place = node.cell.cast<double>() - middleOf(lattice);
    const Eigen::Vector2d n =
        camera.normalizedFromPixel(corners[static_cast<std::size_t>(node.corner)].pixel);
    objects.emplace_back(place.x(), place.y(), 0.0);
    images.emplace_back(n.x(), n.y());
  }
  std::vector<Rigid3> poses;
  try {
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    cv::solvePnPGeneric(objects, images, cv::Matx33d::eye(), cv::noArray(), turns, shifts, false,
                        cv::SOLVEPNP_IPPE);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      cv::Matx33d rotation;
      cv::Rodrigues(turns[i], rotation);
      Rigid3 cam_from_middle;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) cam_from_middle.rotation(r, c) = rotation(r, c);
        cam_from_middle.translation[r] = shifts[i].at<double>(r);
      }
      if (!isRigid(cam_from_middle) || !(cam_from_middle.translation.z() > 0.0)) continue;
      Rigid3 middle_from_lattice;
      middle_from_lattice.translation.head<2>() = -middleOf(lattice);
      poses.push_back(cam_from_middle * middle_from_lattice);
    }
  } catch (const cv::Exception&) {
    poses.clear();
  }
  return poses;
}

double squareHeight_px(const CornerLattice& lattice, std::span<const XCorner> corners) {
  const auto homography = homographyOf(lattice, corners, Eigen::Vector2d::Zero());
  return homography ? leastStretch(homographyJacobian(*homography, {0.0, 0.0})) : 0.0;
}

}  // namespace gyre
