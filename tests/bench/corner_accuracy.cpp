// Prints how far corner detectors miss the truth, over noise and blur: the table of
// docs/algorithms/corner-detection.md.
//
// One corner a picture, checker squares of 20 to 30 px under a random affinity, contrast 150.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/calib/corners/beaudet.h"
#include "core/calib/corners/l_corner.h"
#include "core/calib/corners/saddle_fit.h"
#include "core/calib/corners/x_corner_detector.h"
#include "tests/support/rendered_checker.h"

namespace gyre {
namespace {

using Found = std::optional<Eigen::Vector2d>;
constexpr int kSide_px = 72;
constexpr std::uint64_t kPictures = 400;
// A detector that finds nothing this near has missed the corner.
constexpr double kMissed_px = 5.0;

struct Sample {
  cv::Mat grey;
  Eigen::Vector2d corner_px;
};

// Axes of 20 to 30 px that meet at 60 to 120 degrees, the corner anywhere within a pixel.
Eigen::Matrix3d randomAffinity(Random& random) {
  const double angle_rad = random.uniform(0.0, kTurn_rad);
  const double opening_rad = radFromDeg(random.uniform(60.0, 120.0));
  const double middle_px = 0.5 * (kSide_px - 1);
  Eigen::Matrix3d pixel_from_board = Eigen::Matrix3d::Identity();
  pixel_from_board.topLeftCorner<2, 1>() =
      random.uniform(20.0, 30.0) * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  pixel_from_board.block<2, 1>(0, 1) =
      random.uniform(20.0, 30.0) *
      Eigen::Vector2d(std::cos(angle_rad + opening_rad), std::sin(angle_rad + opening_rad));
  pixel_from_board.topRightCorner<2, 1>() << middle_px + random.uniform(-0.5, 0.5),
      middle_px + random.uniform(-0.5, 0.5);
  return pixel_from_board;
}

template <class PatternOf>
std::vector<Sample> samplesOf(double noise, double psf_px, PatternOf pattern_of) {
  std::vector<Sample> samples;
  for (std::uint64_t i = 0; i < kPictures; ++i) {
    Random random(hashWords({7, i}));
    const Eigen::Matrix3d pixel_from_board = randomAffinity(random);
    CheckerPicture picture;
    picture.width_px = picture.height_px = kSide_px;
    picture.noise = noise;
    picture.psf_px = psf_px;
    picture.seed = random.next();
    samples.push_back({renderPattern(picture, pattern_of(pixel_from_board)),
                       pixel_from_board.topRightCorner<2, 1>()});
  }
  return samples;
}

std::string errorsOf(const std::vector<Sample>& samples,
                     const std::function<Found(const Sample&)>& method) {
  std::vector<double> errors_px;
  for (const Sample& sample : samples) {
    const Found found = method(sample);
    if (!found || (*found - sample.corner_px).norm() > kMissed_px) continue;
    errors_px.push_back((*found - sample.corner_px).norm());
  }
  if (errors_px.empty()) return "-";
  std::sort(errors_px.begin(), errors_px.end());
  double squares = 0.0;
  for (const double error_px : errors_px) squares += error_px * error_px;
  const double rms_px = std::sqrt(squares / static_cast<double>(errors_px.size()));
  char text[64];
  std::snprintf(text, sizeof text, "%.3f/%.3f", errors_px[errors_px.size() / 2], rms_px);
  std::string cell = text;
  const std::size_t missed = samples.size() - errors_px.size();
  if (missed > 0) cell += " (" + std::to_string(missed) + " missed)";
  return cell;
}

// -DET at the fine scale: largest at X-corners.
cv::Mat negativeDet(const Sample& sample) {
  const cv::Mat fine =
      blurredFurther(blurredForSaddles(sample.grey), kSaddleBlur_px, kFineScale_px);
  cv::Mat negative = beaudetDet(fine, kFineScale_px);
  negative *= -1.0;
  return negative;
}

std::optional<Eigen::Vector2i> detPeak(const Sample& sample) {
  std::optional<Eigen::Vector2i> nearest;
  double least_px = kMissed_px;
  for (const ResponsePeak& peak : peaksOf(negativeDet(sample), responseOfContrast(12.0))) {
    const double distance_px = (peak.pixel.cast<double>() - sample.corner_px).norm();
    if (distance_px > least_px) continue;
    least_px = distance_px;
    nearest = peak.pixel;
  }
  return nearest;
}

Found detPixel(const Sample& sample) {
  const auto peak = detPeak(sample);
  return peak ? Found(peak->cast<double>()) : std::nullopt;
}

Found detParabola(const Sample& sample) {
  const auto peak = detPeak(sample);
  if (!peak) return std::nullopt;
  const cv::Mat response = negativeDet(sample);
  const auto top = [&](const Eigen::Vector2i& step) {
    const auto at = [&](int k) {
      return static_cast<double>(
          response.at<float>(peak->y() + k * step.y(), peak->x() + k * step.x()));
    };
    return 0.5 * (at(-1) - at(1)) / (at(-1) - 2.0 * at(0) + at(1));
  };
  return peak->cast<double>() + Eigen::Vector2d(top({1, 0}), top({0, 1}));
}

Found saddleAt(const Sample& sample, int radius_px) {
  const auto peak = detPeak(sample);
  if (!peak) return std::nullopt;
  const auto fit = fitSaddle(blurredForSaddles(sample.grey), peak->cast<double>(), radius_px, 1.0);
  return fit ? Found(fit->pixel) : std::nullopt;
}

template <class Corner>
Found nearestOf(const std::vector<Corner>& corners, const Eigen::Vector2d& truth_px) {
  Found nearest;
  for (const Corner& corner : corners) {
    if (!nearest || (corner.pixel - truth_px).norm() < (*nearest - truth_px).norm()) {
      nearest = corner.pixel;
    }
  }
  return nearest;
}

Found xCorner(const Sample& sample) {
  return nearestOf(detectXCorners(sample.grey), sample.corner_px);
}

Found lCorner(const Sample& sample) {
  return nearestOf(detectLCorners(sample.grey), sample.corner_px);
}

// The uncorrected maximum of DET: displaced inwards.
Found lPixel(const Sample& sample) {
  const cv::Mat det = beaudetDet(
      blurredFurther(blurredForSaddles(sample.grey), kSaddleBlur_px, kFineScale_px), kFineScale_px);
  std::vector<SaddleGuess> peaks;
  for (const ResponsePeak& peak : peaksOf(det, 25.0)) peaks.push_back({peak.pixel.cast<double>()});
  return nearestOf(peaks, sample.corner_px);
}

Found cornerSubPix(const Sample& sample, int window) {
  std::vector<cv::Point2f> corner = {{static_cast<float>(std::lround(sample.corner_px.x())),
                                      static_cast<float>(std::lround(sample.corner_px.y()))}};
  cv::cornerSubPix(sample.grey, corner, {window, window}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-3});
  return Eigen::Vector2d(corner[0].x, corner[0].y);
}

using Method = std::pair<std::string, std::function<Found(const Sample&)>>;

template <class PatternOf>
void printTable(const char* title, const std::vector<Method>& methods, PatternOf pattern_of) {
  const std::vector<std::pair<double, double>> columns = {
      {1.0, 0.8}, {2.0, 0.8}, {5.0, 0.8}, {2.0, 1.5}};  // noise, psf_px
  std::vector<std::vector<Sample>> pictures;
  for (const auto& [noise, psf_px] : columns) {
    pictures.push_back(samplesOf(noise, psf_px, pattern_of));
  }
  std::printf("| %s | noise 1 | noise 2 | noise 5 | PSF 1.5, noise 2 |\n|---|---|---|---|---|\n",
              title);
  for (const auto& [name, method] : methods) {
    std::printf("| %s |", name.c_str());
    for (const auto& samples : pictures) std::printf(" %s |", errorsOf(samples, method).c_str());
    std::printf("\n");
  }
  std::printf("\n");
}

// The processor time that the detector takes for a whole picture full of squares.
void printSpeed() {
  CheckerPicture picture;
  picture.width_px = 1280;
  picture.height_px = 960;
  picture.noise = 2.0;
  Eigen::Matrix3d pixel_from_board = Eigen::Matrix3d::Identity();
  pixel_from_board << 38.0, 7.0, 20.5, -6.0, 41.0, 10.2, 0.0, 0.0, 1.0;
  const cv::Mat grey = renderPattern(picture, checkerPattern(pixel_from_board));
  cv::setNumThreads(1);
  std::vector<double> times_ms;
  std::size_t found = 0;
  for (int run = 0; run < 21; ++run) {
    const std::clock_t start = std::clock();
    found = detectXCorners(grey).size();
    times_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(times_ms.begin(), times_ms.end());
  std::printf("1280 x 960, %zu corners, one core: %.1f ms (median), %.1f ms (best)\n", found,
              times_ms[times_ms.size() / 2], times_ms.front());
}

}  // namespace
}  // namespace gyre

int main() {
  using gyre::Sample;
  std::printf("Median / rms error in px of %d pictures each.\n\n",
              static_cast<int>(gyre::kPictures));
  gyre::printTable("X-corner",
                   {{"DET pixel", gyre::detPixel},
                    {"DET + parabola", gyre::detParabola},
                    {"saddle fit r=3", [](const Sample& s) { return gyre::saddleAt(s, 3); }},
                    {"saddle fit r=5", [](const Sample& s) { return gyre::saddleAt(s, 5); }},
                    {"saddle fit r=6", [](const Sample& s) { return gyre::saddleAt(s, 6); }},
                    {"detectXCorners", gyre::xCorner},
                    {"cornerSubPix w5", [](const Sample& s) { return gyre::cornerSubPix(s, 5); }},
                    {"cornerSubPix w7", [](const Sample& s) { return gyre::cornerSubPix(s, 7); }}},
                   gyre::checkerPattern);
  gyre::printTable("L-corner",
                   {{"DET maximum", gyre::lPixel},
                    {"detectLCorners", gyre::lCorner},
                    {"cornerSubPix w5", [](const Sample& s) { return gyre::cornerSubPix(s, 5); }},
                    {"cornerSubPix w7", [](const Sample& s) { return gyre::cornerSubPix(s, 7); }}},
                   gyre::quarterPattern);
  gyre::printSpeed();
  return 0;
}
