// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/corner_ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr std::size_t kSamples = 16;
// All in shares of half the contrast. A sample nearer to the middle than this is neither bright nor
// dark, so that noise on an edge is no change.
constexpr double kUndecided = 0.1;
constexpr double kFaintest = 0.35;
// How far the two halves of an edge may bend at the corner: perspective and lenses bend a little.
constexpr double kMostBend_rad = radFromDeg(30.0);

using Samples = std::array<double, kSamples>;

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

// A change of sign between one sample and a later one, those between being undecided.
struct Change {
  double angle_rad = 0.0;
  bool to_bright = false;
};

int signOf(double value, double undecided) {
  if (std::abs(value) < undecided) return 0;
  return value > 0.0 ? 1 : -1;
}

// All changes going once round, from the first decided sample on.
std::vector<Change> changesOf(const Samples& samples, double undecided) {
  std::vector<Change> changes;
  const auto first = std::find_if(samples.begin(), samples.end(),
                                  [&](double v) { return signOf(v, undecided) != 0; });
  const auto start = static_cast<std::size_t>(first - samples.begin());
  std::size_t last = start;
  for (std::size_t i = start + 1; i <= start + kSamples; ++i) {
    const double before = samples[last % kSamples];
    const double now = samples[i % kSamples];
    const int sign = signOf(now, undecided);
    if (sign == 0) continue;
    if (sign != signOf(before, undecided)) {
      const double part = before / (before - now);
      const double place = static_cast<double>(last) + part * static_cast<double>(i - last);
      changes.push_back({place * kTurn_rad / kSamples, sign > 0});
    }
    last = i;
  }
  return changes;
}

// Whether each of the four stretches reaches the least brightness or darkness.
bool allStretchesReach(const Samples& samples, const std::vector<Change>& changes, double least) {
  const double step_rad = kTurn_rad / kSamples;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const double from_rad = changes[k].angle_rad;
    double to_rad = changes[(k + 1) % changes.size()].angle_rad;
    if (to_rad <= from_rad) to_rad += kTurn_rad;
    double most = 0.0;
    for (auto i = static_cast<std::size_t>(std::ceil(from_rad / step_rad));
         static_cast<double>(i) * step_rad <= to_rad; ++i) {
      most = std::max(most, std::abs(samples[i % kSamples]));
    }
    if (most < least) return false;
  }
  return true;
}

// The middle of the directions of an edge's two halves, or nothing when it bends.
std::optional<double> straightThrough(double angle_rad, double opposite_rad) {
  const double bend_rad = std::remainder(opposite_rad - angle_rad - kPi, kTurn_rad);
  if (std::abs(bend_rad) > kMostBend_rad) return std::nullopt;
  return angle_rad + 0.5 * bend_rad;
}

}  // namespace

double brightnessAt(const cv::Mat& blurred, const Eigen::Vector2d& pixel) {
  const int column = static_cast<int>(std::floor(pixel.x()));
  const int row = static_cast<int>(std::floor(pixel.y()));
  const double x = pixel.x() - column;
  const double y = pixel.y() - row;
  const float* above = blurred.ptr<float>(row) + column;
  const float* below = blurred.ptr<float>(row + 1) + column;
  return (1.0 - y) * ((1.0 - x) * above[0] + x * above[1]) +
         y * ((1.0 - x) * below[0] + x * below[1]);
}

std::optional<CornerRing> cornerRing(const cv::Mat& blurred, const Eigen::Vector2d& centre_px,
                                     double radius_px) {
  const double reach = radius_px + 1.0;
  // Written so that a centre that is not a number fails too.
  if (!(centre_px.x() >= reach && centre_px.y() >= reach &&
        centre_px.x() <= blurred.cols - 1 - reach && centre_px.y() <= blurred.rows - 1 - reach)) {
    return std::nullopt;
  }
  Samples samples{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double angle_rad = static_cast<double>(i) * kTurn_rad / kSamples;
    samples[i] = brightnessAt(blurred, centre_px + radius_px * direction(angle_rad));
  }
  const auto [darkest, brightest] = std::minmax_element(samples.begin(), samples.end());
  CornerRing ring;
  ring.contrast = *brightest - *darkest;
  const double half = 0.5 * ring.contrast;
  if (!(half > 0.0)) return std::nullopt;
  const double middle = *darkest + half;
  for (double& sample : samples) sample -= middle;

  const std::vector<Change> changes = changesOf(samples, kUndecided * half);
  if (changes.size() != 4 || !allStretchesReach(samples, changes, kFaintest * half)) {
    return std::nullopt;
  }
  const std::size_t bright = changes[0].to_bright ? 0 : 1;
  const auto a_rad = straightThrough(changes[bright].angle_rad, changes[bright + 2].angle_rad);
  const auto b_rad =
      straightThrough(changes[bright + 1].angle_rad, changes[(bright + 3) % 4].angle_rad);
  if (!a_rad || !b_rad) return std::nullopt;
  ring.edge_a = direction(*a_rad);
  ring.edge_b = direction(*b_rad);
  return ring;
}

}  // namespace gyre
