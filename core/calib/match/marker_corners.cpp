// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/marker_corners.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace gyre {
namespace {

constexpr double kStep_px = 0.5;  // between the samples of a profile
constexpr double kMargin = 0.12;  // of a side, left out at both ends
constexpr double kLeastModule_px = 2.0;
constexpr double kLeastContrast = 8.0;  // grey levels
constexpr std::size_t kLeastEdges = 6;
constexpr int kRounds = 4;
// Neighbouring profiles share pixels: that many stand for one independent.
constexpr double kProfilesAPixel = 1.5;
// What no scatter shows: the bow of a side by the lens, unlike blur of its two slopes.
constexpr double kSystematicSigma_px = 0.02;

// A side: a point on it, its direction, and what is known of both.
struct Side {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  double scatter_px = 0.0;
  double count = 0.0;   // of independent edges
  double spread = 0.0;  // sum of their squared distances from the middle along the side

  Eigen::Vector2d outward() const { return {along.y(), -along.x()}; }  // the corners go clockwise
  // Variance of the line's place at a distance from its middle.
  double variance(double distance) const {
    return scatter_px * scatter_px * (1.0 / count + distance * distance / spread) +
           kSystematicSigma_px * kSystematicSigma_px;
  }
};

std::optional<double> sample(const cv::Mat& grey, const Eigen::Vector2d& pixel) {
  if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < grey.cols - 1 &&
        pixel.y() < grey.rows - 1)) {
    return std::nullopt;
  }
  const int x = static_cast<int>(pixel.x());
  const int y = static_cast<int>(pixel.y());
  const double fx = pixel.x() - x;
  const double fy = pixel.y() - y;
  const auto* upper = grey.ptr<unsigned char>(y) + x;
  const auto* lower = grey.ptr<unsigned char>(y + 1) + x;
  return (1.0 - fy) * ((1.0 - fx) * upper[0] + fx * upper[1]) +
         fy * ((1.0 - fx) * lower[0] + fx * lower[1]);
}

// The rise of the brightness from one end of a stretch outward to its other, and the place of its
// centre of gravity relative to the middle of the stretch.
struct Rise {
  double grey = 0.0;
  double offset_px = 0.0;
};
std::optional<Rise> riseAbout(const cv::Mat& grey, const Eigen::Vector2d& middle,
                              const Eigen::Vector2d& outward, double reach_px) {
  const int half = std::max(1, static_cast<int>(std::ceil(reach_px / kStep_px)));
  const double step_px = reach_px / half;
  Rise rise;
  double moment = 0.0;
  std::optional<double> before = sample(grey, middle - reach_px * outward);
  for (int i = -half + 1; i <= half; ++i) {
    const auto here = sample(grey, middle + i * step_px * outward);
    if (!before || !here) return std::nullopt;
    rise.grey += *here - *before;
    moment += (*here - *before) * (i - 0.5) * step_px;
    before = here;
  }
  if (rise.grey > kLeastContrast) rise.offset_px = moment / rise.grey;
  return rise;
}

// How far outward of the start the brightness steps up.
//
// module_px: how far away the next edges on either side may be. They are steps down as one goes
// outward, so the steepest rise is the edge; about it, only the half of a module counts that their
// blur does not reach.
std::optional<double> edgeOffset(const cv::Mat& grey, const Eigen::Vector2d& start,
                                 const Eigen::Vector2d& outward, double module_px) {
  const int search = static_cast<int>(std::min(0.8 * module_px, 5.0) / kStep_px);
  double offset = 0.0;
  double steepest = kLeastContrast;
  for (int i = -search; i <= search; ++i) {
    const auto rise = riseAbout(grey, start + i * kStep_px * outward, outward, 1.0);
    if (!rise) return std::nullopt;
    if (rise->grey <= steepest) continue;
    steepest = rise->grey;
    offset = i * kStep_px;
  }
  if (steepest <= kLeastContrast) return std::nullopt;
  // A stretch that is cut off pulls towards its middle until that is the edge itself.
  const double reach_px = std::clamp(0.5 * module_px, 1.25, 3.0);
  for (int round = 0; round < kRounds; ++round) {
    const auto rise = riseAbout(grey, start + offset * outward, outward, reach_px);
    if (!rise || rise->grey <= kLeastContrast || std::abs(rise->offset_px) > reach_px) {
      return std::nullopt;
    }
    offset += rise->offset_px;
  }
  if (std::abs(offset) > module_px) return std::nullopt;
  return offset;
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The line that the edges scatter least about, without those further off than 3 scatters.
std::optional<Side> lineThrough(std::vector<Eigen::Vector2d> edges, const Eigen::Vector2d& along) {
  Side side;
  for (int round = 0; round < 3; ++round) {
    if (edges.size() < kLeastEdges) return std::nullopt;
    side.middle.setZero();
    for (const auto& edge : edges) side.middle += edge / static_cast<double>(edges.size());
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const auto& edge : edges) {
      scatter += (edge - side.middle) * (edge - side.middle).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
    side.along = solver.eigenvectors().col(1);
    if (side.along.dot(along) < 0.0) side.along *= -1.0;
    side.count = static_cast<double>(edges.size()) / kProfilesAPixel;
    side.spread = solver.eigenvalues()[1] / kProfilesAPixel;
    side.scatter_px =
        std::sqrt(solver.eigenvalues()[0] / (static_cast<double>(edges.size()) - 2.0));
    std::vector<double> misses;
    misses.reserve(edges.size());
    for (const auto& edge : edges) {
      misses.push_back(std::abs(side.outward().dot(edge - side.middle)));
    }
    const double most = std::max(0.05, 3.0 * 1.4826 * medianOf(misses));
    const auto before = edges.size();
    std::erase_if(edges, [&](const Eigen::Vector2d& edge) {
      return std::abs(side.outward().dot(edge - side.middle)) > most;
    });
    if (edges.size() == before) break;
  }
  return side;
}

// The edges along the side that begins at a corner.
std::optional<Side> measureSide(const cv::Mat& grey, const MarkerCorners& corners, std::size_t k,
                                int modules_a_side) {
  const Eigen::Vector2d& from = corners[k];
  const Eigen::Vector2d& to = corners[(k + 1) % 4];
  const double length_px = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length_px;
  const Eigen::Vector2d outward(along.y(), -along.x());
  // The border of the code is one module wide, measured across the side.
  const double depth_px =
      std::min(-outward.dot(corners[(k + 2) % 4] - to), -outward.dot(corners[(k + 3) % 4] - from));
  const double module_px = std::min(depth_px, length_px) / modules_a_side;
  if (!(module_px >= kLeastModule_px)) return std::nullopt;
  const int count = std::max(8, static_cast<int>(std::lround(length_px * (1.0 - 2.0 * kMargin))));
  std::vector<Eigen::Vector2d> edges;
  for (int i = 0; i < count; ++i) {
    const double share = kMargin + (1.0 - 2.0 * kMargin) * (i + 0.5) / count;
    const Eigen::Vector2d start = from + share * (to - from);
    if (const auto offset = edgeOffset(grey, start, outward, depth_px / modules_a_side)) {
      edges.emplace_back(start + *offset * outward);
    }
  }
  if (2 * edges.size() < static_cast<std::size_t>(count)) return std::nullopt;
  return lineThrough(std::move(edges), along);
}

}  // namespace

std::optional<RefinedMarker> refineMarker(const cv::Mat& grey, const MarkerCorners& rough,
                                          int modules_a_side) {
  RefinedMarker refined;
  refined.corners = rough;
  // Again from better corners: which stretch of a side is looked at follows from them.
  for (int round = 0; round < 2; ++round) {
    std::array<Side, 4> sides;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto side = measureSide(grey, refined.corners, k, modules_a_side);
      if (!side) return std::nullopt;
      sides[k] = *side;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Side& one = sides[(k + 3) % 4];
      const Side& two = sides[k];
      Eigen::Matrix2d normals;
      normals << one.outward().transpose(), two.outward().transpose();
      if (std::abs(normals.determinant()) < 0.1) return std::nullopt;
      const Eigen::Matrix2d inverse = normals.inverse();
      const Eigen::Vector2d corner =
          inverse * Eigen::Vector2d(one.outward().dot(one.middle), two.outward().dot(two.middle));
      const Eigen::Vector2d variances(one.variance((corner - one.middle).norm()),
                                      two.variance((corner - two.middle).norm()));
      const Eigen::Matrix2d covariance = inverse * variances.asDiagonal() * inverse.transpose();
      refined.corners[k] = corner;
      refined.sigma_px[k] = std::sqrt(0.5 * covariance.trace());
      if (!((corner - rough[k]).norm() < 0.25 * (rough[(k + 2) % 4] - rough[k]).norm())) {
        return std::nullopt;
      }
    }
  }
  return refined;
}

}  // namespace gyre
