// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/x_corner_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/base/units.h"
#include "core/calib/corners/beaudet.h"
#include "core/calib/corners/corner_ring.h"
#include "core/calib/corners/picture_noise.h"
#include "core/calib/corners/saddle_fit.h"

namespace gyre {
namespace {

// The first two must alternate, the others tell how large the squares are.
constexpr std::array<double, 8> kRings_px = {3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.5, 15.0};
constexpr std::size_t kNeededRings = 2;
constexpr double kDiscOverSquare = 0.4;
constexpr int kFirstRadius_px = 3;
// How many times its own noise a response must be: noise alone has corners in every picture.
constexpr double kNoiseMargin = 6.0;

// How far rings around the corner alternate with edges that point the same way, or nothing when
// even the smallest do not.
std::optional<double> clearRadius(const cv::Mat& blurred, const Eigen::Vector2d& pixel) {
  std::optional<double> clear_px;
  Eigen::Vector2d bright_before = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < kRings_px.size(); ++i) {
    const auto ring = cornerRing(blurred, pixel, kRings_px[i]);
    if (!ring) break;
    // The bright squares stay where they are as the ring grows, or it has come to other squares.
    const Eigen::Vector2d bright = (ring->edge_a + ring->edge_b).normalized();
    if (i > 0 && std::abs(bright.dot(bright_before)) < std::cos(radFromDeg(20.0))) break;
    bright_before = bright;
    if (i + 1 >= kNeededRings) clear_px = kRings_px[i];
  }
  return clear_px;
}

std::optional<XCorner> examine(const cv::Mat& blurred, const Eigen::Vector2d& start_px,
                               double noise_grey) {
  const auto rough = fitSaddle(blurred, start_px, kFirstRadius_px, noise_grey);
  if (!rough) return std::nullopt;
  const auto clear_px = clearRadius(blurred, rough->pixel);
  if (!clear_px) return std::nullopt;
  const int radius_px = static_cast<int>(kDiscOverSquare * *clear_px);
  const auto fit = fitSaddle(blurred, rough->pixel, radius_px, noise_grey);
  if (!fit) return std::nullopt;
  XCorner corner;
  corner.pixel = fit->pixel;
  corner.sigma_px = fit->sigma_px;
  corner.edge_a = fit->edge_a;
  corner.edge_b = fit->edge_b;
  corner.clear_radius_px = *clear_px;
  return corner;
}

// Two maxima of the response may slide into the same saddle: keep the stronger.
void dropDoubles(std::vector<XCorner>& corners, const cv::Size& size) {
  constexpr double kSame_px = 1.5;
  constexpr int kCell_px = 2;
  cv::Mat owner(size.height / kCell_px + 1, size.width / kCell_px + 1, CV_32S, cv::Scalar(-1));
  std::vector<XCorner> kept;
  for (const XCorner& corner : corners) {
    const int column = static_cast<int>(corner.pixel.x()) / kCell_px;
    const int row = static_cast<int>(corner.pixel.y()) / kCell_px;
    bool is_double = false;
    for (int r = std::max(0, row - 1); r <= std::min(owner.rows - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(owner.cols - 1, column + 1); ++c) {
        const int other = owner.at<int>(r, c);
        if (other < 0) continue;
        const XCorner& earlier = kept[static_cast<std::size_t>(other)];
        is_double |= (earlier.pixel - corner.pixel).norm() < kSame_px;
      }
    }
    if (is_double) continue;
    owner.at<int>(row, column) = static_cast<int>(kept.size());
    kept.push_back(corner);
  }
  corners = std::move(kept);
}

}  // namespace

Result<void> XCornerOptions::validate() const {
  if (min_contrast >= 1.0 && min_contrast <= 255.0 && min_relative_contrast >= 0.0 &&
      min_relative_contrast < 1.0 && max_corners >= 1 && max_corners <= 1000000) {
    return {};
  }
  return Error{Error::Code::kInvalidInput, "An option of the corner detector is out of its range.",
               "Use a contrast from 1 to 255 and a relative contrast from 0 to below 1."};
}

std::vector<XCorner> detectXCorners(const cv::Mat& grey, const XCornerOptions& options) {
  GYRE_CHECK(options.validate().ok());
  if (grey.empty()) return {};
  const cv::Mat blurred = blurredForSaddles(grey);
  const double noise_grey = pictureNoise(grey);
  const cv::Mat response = saddleResponse(blurred);

  double strongest = 0.0;
  cv::minMaxLoc(response, nullptr, &strongest);
  const double least = std::max({options.min_contrast, kNoiseMargin * noise_grey,
                                 options.min_relative_contrast * contrastOfResponse(strongest)});
  std::vector<XCorner> corners;
  for (const ResponsePeak& peak : peaksOf(response, responseOfContrast(least))) {
    auto corner = examine(blurred, peak.pixel.cast<double>(), noise_grey);
    if (!corner) continue;
    corner->strength = contrastOfResponse(peak.response);
    corners.push_back(*corner);
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const XCorner& a, const XCorner& b) { return a.strength > b.strength; });
  dropDoubles(corners, grey.size());
  if (corners.size() > static_cast<std::size_t>(options.max_corners)) {
    corners.resize(static_cast<std::size_t>(options.max_corners));
  }
  return corners;
}

}  // namespace gyre
