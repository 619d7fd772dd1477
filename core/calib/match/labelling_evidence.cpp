// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/labelling_evidence.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/calib/corners/corner_ring.h"

namespace gyre {
namespace {

constexpr double kPlainView = 0.35;  // cosine from which a face must show its corners
constexpr double kBorder_px = 8.0;
constexpr double kLeastDot_px = 3.0;    // radius from which a mark must be seen
constexpr double kSeenContrast = 0.35;  // of that between bright and dark squares
constexpr double kUnseenContrast = 0.15;

std::optional<double> brightnessOf(const AssignmentInput& input, const RoughPose& pose,
                                   const Eigen::Vector3d& point_in_target) {
  const auto pixel = pose.camera.project(pose.cam_from_target * point_in_target);
  const cv::Mat& picture = input.picture.blurred;
  if (!pixel || pixel->x() < 1.0 || pixel->y() < 1.0 || pixel->x() > picture.cols - 2.0 ||
      pixel->y() > picture.rows - 2.0) {
    return std::nullopt;
  }
  return brightnessAt(picture, *pixel);
}

// 1: the mark is there. -1: it is not, and should be. 0: the picture does not tell.
int markSeen(const AssignmentInput& input, const LatticeAssignment& labelling,
             const TargetDot& dot) {
  const RoughPose& pose = labelling.pose;
  const auto face = std::find_if(input.faces.begin(), input.faces.end(), [&](const auto& each) {
    return each.grid && each.holds(dot.centre_in_target);
  });
  if (face == input.faces.end() || !looksAtCamera(*face, pose.cam_from_target, kPlainView)) {
    return 0;
  }
  const auto brightness_at = [&](const Eigen::Vector2d& offset_mm) {
    return brightnessOf(input, pose,
                        dot.centre_in_target + offset_mm.x() * face->right_in_target +
                            offset_mm.y() * face->down_in_target);
  };
  const double radius_mm = 0.5 * dot.diameter_mm;
  const double square_mm = face->grid->pitch_mm.minCoeff();
  const double distance_mm = (pose.cam_from_target * dot.centre_in_target).z();
  if (radius_mm * pose.camera.fy / distance_mm < kLeastDot_px) return 0;
  // Between the mark's rim and the square's edges, and the same ring in the next square.
  const double ring_mm = 0.5 * (radius_mm + 0.5 * square_mm);
  double around = 0.0;
  double beside = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double angle_rad = 0.25 * kTurn_rad * k;
    const Eigen::Vector2d way(std::cos(angle_rad), std::sin(angle_rad));
    const auto near = brightness_at(ring_mm * way);
    const auto next = brightness_at(square_mm * way);
    if (!near || !next) return 0;
    around += 0.25 * *near;
    beside += 0.25 * *next;
  }
  const auto middle = brightness_at({0.0, 0.0});
  if (!middle || std::abs(beside - around) < 1.0) return 0;
  // 1 when the middle is as bright as the squares beside, 0 when it is as its own.
  const double contrast = (*middle - around) / (beside - around);
  if (contrast > kSeenContrast) return 1;
  return contrast < kUnseenContrast ? -1 : 0;
}

// Keeps those for which the score is no more than the slack behind the best.
template <class Score>
void keepBest(std::vector<LatticeAssignment>& labellings, double slack, Score score) {
  double best = -1e300;
  std::vector<double> scores;
  for (const auto& each : labellings) {
    scores.push_back(score(each));
    best = std::max(best, scores.back());
  }
  std::vector<LatticeAssignment> kept;
  for (std::size_t i = 0; i < labellings.size(); ++i) {
    if (scores[i] >= best - slack) kept.push_back(std::move(labellings[i]));
  }
  labellings = std::move(kept);
}

double turnBetween(const Rigid3& a, const Rigid3& b) {
  return Eigen::AngleAxisd(a.rotation.transpose() * b.rotation).angle();
}

double darkMatch(const AssignmentInput& input, const LatticeAssignment& labelling) {
  double sum = 0.0;
  for (const LatticeOnFace& laid : labelling.laid) {
    const CornerLattice& lattice = input.lattices[static_cast<std::size_t>(laid.lattice)];
    sum += darkSquareMatch(lattice, laid, input.faces[static_cast<std::size_t>(laid.face)]) *
           static_cast<double>(lattice.nodes.size());
  }
  return sum;
}

}  // namespace

bool looksAtCamera(const TargetFace& face, const Rigid3& cam_from_target, double least_cosine) {
  if (face.corners.empty()) return false;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& corner : face.corners) {
    middle += corner.place_mm / static_cast<double>(face.corners.size());
  }
  const Eigen::Vector3d middle_in_cam = cam_from_target * face.pointAt(middle);
  const Eigen::Vector3d outward_in_cam = cam_from_target.rotation * face.outwardInTarget();
  return -outward_in_cam.dot(middle_in_cam.normalized()) > least_cosine;
}

int missingCorners(const AssignmentInput& input, const LatticeAssignment& labelling) {
  std::set<std::pair<int, int>> covered;
  for (const LatticeOnFace& laid : labelling.laid) {
    const TargetFace& face = input.faces[static_cast<std::size_t>(laid.face)];
    for (const auto& node : input.lattices[static_cast<std::size_t>(laid.lattice)].nodes) {
      const Eigen::Vector2i cell = cellOnFace(laid, node.cell);
      covered.emplace(laid.face, face.grid->cornerAt(cell.x(), cell.y()));
    }
  }
  const RoughPose& pose = labelling.pose;
  int missing = 0;
  for (const TargetFace& face : input.faces) {
    if (!looksAtCamera(face, pose.cam_from_target, kPlainView)) continue;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      if (covered.contains({face.index, static_cast<int>(i)})) continue;
      const auto pixel =
          pose.camera.project(pose.cam_from_target * face.pointAt(face.corners[i].place_mm));
      missing += static_cast<int>(pixel && pose.camera.contains(*pixel, kBorder_px));
    }
  }
  return missing;
}

int marksSeen(const AssignmentInput& input, const LatticeAssignment& labelling) {
  int seen = 0;
  for (const TargetDot& dot : input.target.dots) seen += markSeen(input, labelling, dot);
  return seen;
}

std::optional<LatticeAssignment> bestLabelling(const AssignmentInput& input,
                                               std::vector<LatticeAssignment> labellings) {
  if (labellings.empty()) return std::nullopt;
  const auto corners = [](const auto& each) { return static_cast<double>(each.corners); };
  int most = 0;
  for (const auto& each : labellings) most = std::max(most, each.corners);
  // A labelling that lacks a few corners of a lattice's rim is as good as one that has them.
  keepBest(labellings, 0.03 * most, corners);
  double least_rms_px = 1e300;
  for (const auto& each : labellings) least_rms_px = std::min(least_rms_px, each.pose.rms_px);
  keepBest(labellings, 0.4 * least_rms_px + 0.15,
           [](const auto& each) { return -each.pose.rms_px; });
  keepBest(labellings, 4.0, [](const auto& each) { return -static_cast<double>(each.missing); });
  keepBest(labellings, 0.5, [&](const auto& each) { return marksSeen(input, each); });
  keepBest(labellings, 0.5, [&](const auto& each) { return darkMatch(input, each); });
  if (input.expected_cam_from_target) {
    // Symmetric labellings are far apart: the expected one is within a few degrees.
    keepBest(labellings, radFromDeg(5.0), [&](const auto& each) {
      return -turnBetween(each.pose.cam_from_target, *input.expected_cam_from_target);
    });
  }
  for (std::size_t i = 1; i < labellings.size(); ++i) {
    labellings.front().others.push_back(labellings[i].pose.cam_from_target);
  }
  return labellings.front();
}

}  // namespace gyre
