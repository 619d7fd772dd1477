// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/lattice_assignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "core/calib/match/labelling_evidence.h"
#include "core/calib/match/lattice_pose.h"

namespace gyre {
namespace {

constexpr std::size_t kBases = 4;     // of the largest lattices that give poses
constexpr std::size_t kRefined = 60;  // most labellings that are refined
constexpr double kRoughFit = 0.6;     // of a square: where a rough pose may put a lattice
constexpr double kFineFit = 0.12;     // of a square: rms of a lattice under a refined pose
constexpr double kRoughFocals[] = {0.8, 1.3, 2.0, 4.0};  // in widths of the picture

class Assigner {
 public:
  explicit Assigner(const AssignmentInput& input) : in_(input) {
    for (const CornerLattice& lattice : in_.lattices) {
      square_px_.push_back(squareHeight_px(lattice, in_.corners));
      auto& ways = ways_.emplace_back();
      for (const TargetFace& face : in_.faces) {
        const auto more = waysToLay(lattice, static_cast<int>(ways_.size()) - 1, face);
        ways.insert(ways.end(), more.begin(), more.end());
      }
    }
  }

  // Every labelling that a rough pose suggests, the most promising first.
  std::vector<LatticeAssignment> suggestions(const Task& task) {
    std::vector<LatticeAssignment> found;
    for (const CameraModel& camera : cameras()) {
      std::size_t bases = 0;
      for (std::size_t i = 0; i < in_.lattices.size() && bases < kBases; ++i) {
        if (ways_[i].empty() || task.stopRequested()) continue;
        ++bases;
        for (const Rigid3& cam_from_lattice :
             posesOfLattice(in_.lattices[i], in_.corners, camera)) {
          for (const LatticeOnFace& way : ways_[i]) {
            RoughPose pose{camera, poseOf(way, cam_from_lattice), 0.0};
            if (auto made = gather(way, pose)) found.push_back(std::move(*made));
          }
        }
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.corners != b.corners ? a.corners > b.corners : a.pose.rms_px < b.pose.rms_px;
    });
    std::vector<LatticeAssignment> distinct;
    for (auto& each : found) {
      const bool known = std::any_of(distinct.begin(), distinct.end(),
                                     [&](const auto& other) { return other.laid == each.laid; });
      if (!known && distinct.size() < kRefined) distinct.push_back(std::move(each));
    }
    return distinct;
  }

  // With the pose refined; without lattices that then do not fit. False when none does.
  bool refine(LatticeAssignment& labelling) const {
    const PoseFreedom freedom = in_.camera ? PoseFreedom::kPose : PoseFreedom::kFocalAndK1;
    while (!labelling.laid.empty()) {
      const auto points = pointsUnder(labelling.laid);
      auto pose = refineRoughPose(points, labelling.pose, freedom);
      if (!pose) pose = findRoughPose(points, labelling.pose.camera, freedom);
      if (!pose) return false;
      labelling.pose = *pose;
      auto worst = labelling.laid.end();
      double most = kFineFit;
      for (auto it = labelling.laid.begin(); it != labelling.laid.end(); ++it) {
        const double miss = missOf(*it, *pose);
        if (miss > most) {
          most = miss;
          worst = it;
        }
      }
      if (worst == labelling.laid.end()) {
        labelling.corners = static_cast<int>(points.size());
        labelling.missing = missingCorners(in_, labelling);
        return true;
      }
      labelling.laid.erase(worst);
    }
    return false;
  }

 private:
  const XCorner& cornerOf(const LatticeNode& node) const {
    return in_.corners[static_cast<std::size_t>(node.corner)];
  }
  const TargetFace& faceOf(const LatticeOnFace& laid) const {
    return in_.faces[static_cast<std::size_t>(laid.face)];
  }
  const CornerLattice& latticeOf(const LatticeOnFace& laid) const {
    return in_.lattices[static_cast<std::size_t>(laid.lattice)];
  }

  std::vector<CameraModel> cameras() const {
    if (in_.camera) return {*in_.camera};
    const CameraModel plain = unknownCamera(in_.picture.grey.cols, in_.picture.grey.rows);
    std::vector<CameraModel> cameras;
    const auto focal_px =
        focalFromLattices(in_.lattices, in_.corners, Eigen::Vector2d(plain.cx, plain.cy));
    const auto add = [&](double focal) {
      cameras.push_back(plain);
      cameras.back().fx = cameras.back().fy = focal;
    };
    const double width = plain.width_px;
    if (focal_px && *focal_px > 0.4 * width && *focal_px < 10.0 * width) add(*focal_px);
    if (cameras.empty()) {
      for (const double widths : kRoughFocals) add(widths * width);
    }
    return cameras;
  }

  // cam_from_target of a lattice that lies so on a face. The lattice's frame has squares of 1.
  Rigid3 poseOf(const LatticeOnFace& way, const Rigid3& cam_from_lattice) const {
    const TargetFace& face = faceOf(way);
    const auto point_of = [&](const Eigen::Vector2i& cell) -> Eigen::Vector3d {
      const Eigen::Vector2d first = firstPlace(face);
      return face.pointAt(first +
                          cellOnFace(way, cell).cast<double>().cwiseProduct(face.grid->pitch_mm));
    };
    const Eigen::Vector3d origin = point_of({0, 0});
    Rigid3 target_from_lattice;
    target_from_lattice.rotation.col(0) = (point_of({1, 0}) - origin).normalized();
    target_from_lattice.rotation.col(1) = (point_of({0, 1}) - origin).normalized();
    target_from_lattice.rotation.col(2) = -face.outwardInTarget();
    target_from_lattice.translation = origin;
    Rigid3 scaled = cam_from_lattice;
    scaled.translation *= face.grid->pitch_mm.mean();
    return scaled * target_from_lattice.inverse();
  }

  static Eigen::Vector2d firstPlace(const TargetFace& face) {
    Eigen::Vector2d least = face.corners.front().place_mm;
    for (const auto& corner : face.corners) least = least.cwiseMin(corner.place_mm);
    return least;
  }

  // Where a pose shows all corners of the faces that look at the camera; far away for the others.
  std::vector<std::vector<Eigen::Vector2d>> project(const RoughPose& pose) const {
    std::vector<std::vector<Eigen::Vector2d>> pixels;
    for (const TargetFace& face : in_.faces) {
      auto& row = pixels.emplace_back(face.corners.size(), Eigen::Vector2d::Constant(1e9));
      if (!looksAtCamera(face, pose.cam_from_target, 0.0)) continue;
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const auto pixel =
            pose.camera.project(pose.cam_from_target * face.pointAt(face.corners[i].place_mm));
        if (pixel) row[i] = *pixel;
      }
    }
    return pixels;
  }

  int cornerUnder(const LatticeOnFace& laid, const LatticeNode& node) const {
    const Eigen::Vector2i cell = cellOnFace(laid, node.cell);
    return faceOf(laid).grid->cornerAt(cell.x(), cell.y());
  }

  // Root mean square distance of the lattice's corners from where they should be, in squares.
  double missUnder(const LatticeOnFace& laid,
                   const std::vector<std::vector<Eigen::Vector2d>>& pixels) const {
    double sum = 0.0;
    int count = 0;
    for (const LatticeNode& node : latticeOf(laid).nodes) {
      const int corner = cornerUnder(laid, node);
      if (corner < 0) continue;
      const Eigen::Vector2d& pixel =
          pixels[static_cast<std::size_t>(laid.face)][static_cast<std::size_t>(corner)];
      sum += (pixel - cornerOf(node).pixel).squaredNorm();
      ++count;
    }
    const double square_px = square_px_[static_cast<std::size_t>(laid.lattice)];
    return count > 0 && square_px > 0.0 ? std::sqrt(sum / count) / square_px : 1e9;
  }

  double missOf(const LatticeOnFace& laid, const RoughPose& pose) const {
    return missUnder(laid, project(pose));
  }

  // The lattices that lie where the pose says, beside the one that gave it.
  std::optional<LatticeAssignment> gather(const LatticeOnFace& base, const RoughPose& pose) const {
    const auto pixels = project(pose);
    double sum = missUnder(base, pixels);
    if (sum > kRoughFit) return std::nullopt;
    LatticeAssignment made;
    made.pose = pose;
    made.laid = {base};
    std::set<std::pair<int, int>> covered;
    cover(base, covered);
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      if (static_cast<int>(i) == base.lattice) continue;
      const LatticeOnFace* best = nullptr;
      double least = kRoughFit;
      for (const LatticeOnFace& way : ways_[i]) {
        const double miss = missUnder(way, pixels);
        if (miss >= least || overlaps(way, covered)) continue;
        least = miss;
        best = &way;
      }
      if (best == nullptr) continue;
      made.laid.push_back(*best);
      cover(*best, covered);
      sum += least;
    }
    std::sort(made.laid.begin(), made.laid.end(),
              [](const auto& a, const auto& b) { return a.lattice < b.lattice; });
    made.corners = static_cast<int>(covered.size());
    made.pose.rms_px = sum / static_cast<double>(made.laid.size());  // in squares, for the order
    return made;
  }

  void cover(const LatticeOnFace& laid, std::set<std::pair<int, int>>& covered) const {
    for (const LatticeNode& node : latticeOf(laid).nodes) {
      const int corner = cornerUnder(laid, node);
      if (corner >= 0) covered.emplace(laid.face, corner);
    }
  }

  bool overlaps(const LatticeOnFace& way, const std::set<std::pair<int, int>>& covered) const {
    const auto& nodes = latticeOf(way).nodes;
    return std::any_of(nodes.begin(), nodes.end(), [&](const LatticeNode& node) {
      return covered.contains({way.face, cornerUnder(way, node)});
    });
  }

  std::vector<KnownPoint> pointsUnder(const std::vector<LatticeOnFace>& laid) const {
    std::vector<KnownPoint> points;
    for (const LatticeOnFace& each : laid) {
      const TargetFace& face = faceOf(each);
      for (const LatticeNode& node : latticeOf(each).nodes) {
        const int corner = cornerUnder(each, node);
        if (corner < 0) continue;
        points.push_back({face.pointAt(face.corners[static_cast<std::size_t>(corner)].place_mm),
                          cornerOf(node).pixel, cornerOf(node).sigma_px});
      }
    }
    return points;
  }

  const AssignmentInput& in_;
  std::vector<double> square_px_;                 // of each lattice
  std::vector<std::vector<LatticeOnFace>> ways_;  // of each lattice
};

}  // namespace

std::optional<LatticeAssignment> assignLattices(const AssignmentInput& input, const Task& task) {
  Assigner assigner(input);
  std::vector<LatticeAssignment> labellings;
  for (LatticeAssignment& each : assigner.suggestions(task)) {
    if (task.stopRequested()) return std::nullopt;
    // The most promising come first: what is far behind will not catch up.
    if (!labellings.empty() && each.corners < labellings.front().corners * 3 / 4) break;
    if (!assigner.refine(each)) continue;
    const bool known = std::any_of(labellings.begin(), labellings.end(),
                                   [&](const auto& other) { return other.laid == each.laid; });
    if (!known) labellings.push_back(std::move(each));
  }
  return bestLabelling(input, std::move(labellings));
}

}  // namespace gyre
