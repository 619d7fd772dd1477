// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/stands_as_before.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/formatted.h"
#include "core/base/median.h"
#include "core/base/units.h"
#include "core/pipeline/match_pictures.h"
#include "core/recover/turn_steps.h"
#include "core/track/common_motion.h"
#include "core/track/grey_pyramid.h"
#include "core/track/search_volume.h"
#include "core/track/still_patches.h"
#include "core/track/view_matches.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastPieces = 12;
// Of a picture 640 px wide: what noise, flicker and the motor's own error leave.
constexpr double kStill_working_px = 0.8;
// Pieces that a shadow changed or a passer-by covered; an object has more.
constexpr double kShareChanged = 0.05;
constexpr std::size_t kFewChanged = 3;

// Views to compare with, spread over those captured: neighbours are wanted, whichever they are.
constexpr std::size_t kViewsTried = 12;
constexpr std::size_t kLeastMatches = 20;
constexpr double kTolerance_px = 1.0;
constexpr double kLeastStep_rad = radFromDeg(0.5);
constexpr double kMostStep_rad = radFromDeg(35.0);
constexpr double kAgree_rad = radFromDeg(1.0);
constexpr std::size_t kLeastAgreeing = 2;

struct Moved {
  std::size_t found = 0;
  std::size_t displaced = 0;  // found elsewhere than where the rest went
  std::size_t lost = 0;       // found nowhere near
  double camera_px = 0.0;     // what the most moved together
};

Moved compare(const StillPatches& patches, const cv::Mat& now_bgr) {
  const cv::Mat grey = patches.workingGrey(now_bgr);
  auto motions = patches.motionsNear(grey, {});
  const auto anywhere = patches.motionsAnywhere(grey);
  std::vector<ImageMotion> found;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i]) motions[i] = anywhere[i];
    if (motions[i]) found.push_back({patches.placeOf(i), *motions[i]});
  }
  Moved moved;
  moved.found = found.size();
  moved.lost = patches.count() - found.size();
  const double still_px = kStill_working_px * patches.pxPerWorkingPx();
  const auto shared = sharedMotion(found, still_px);
  if (shared) moved.camera_px = shared->rmsPx(patches.pictureSizePx());
  for (const ImageMotion& each : found) {
    const Eigen::Vector2d expected =
        shared ? shared->at(each.place) : Eigen::Vector2d(Eigen::Vector2d::Zero());
    if ((each.moved - expected).norm() > still_px) ++moved.displaced;
  }
  return moved;
}

// How far the table turned from one view to another; nothing when that cannot be told.
std::optional<double> turnBetween(const ViewSpots& from, const ViewSpots& to,
                                  const Calibration& calibration) {
  TurnMatches matches;
  matches.pairs.push_back(undistorted(calibration.camera, matchSpots(from, to)));
  if (matches.pairs.front().size() < kLeastMatches) return std::nullopt;
  matches.wide = matches.pairs.front();
  TurnStepsOptions options;
  options.tolerance = kTolerance_px / std::sqrt(calibration.camera.fx * calibration.camera.fy);
  options.least_step_rad = kLeastStep_rad;
  options.most_step_rad = kMostStep_rad;
  options.most_radius_mm = visibleVolume(calibration.camera, *calibration.cam_from_table).radius_mm;
  const auto steps = turnSteps(matches, *calibration.cam_from_table, options);
  if (!steps || steps->agreeing < kLeastMatches) return std::nullopt;
  return steps->steps_rad.front();
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, kTurn_rad); }

// The angle that the most others agree with, as the median of those.
std::optional<double> agreed(const std::vector<double>& angles_rad) {
  std::vector<double> best;
  for (const double middle : angles_rad) {
    std::vector<double> near;
    for (const double other : angles_rad) {
      const double off = wrapped(other - middle);
      if (std::abs(off) <= kAgree_rad) near.push_back(middle + off);
    }
    if (near.size() > best.size()) best = std::move(near);
  }
  // One that stands against several is believed as little as two that stand against two.
  if (best.size() < kLeastAgreeing || 2 * best.size() <= angles_rad.size()) return std::nullopt;
  return median(std::move(best));
}

}  // namespace

StandsCheck standsAsBefore(const cv::Mat& then_bgr, const cv::Mat& now_bgr) {
  StandsCheck check;
  check.sentence = "The pictures show too little to tell whether all stands as it stood.";
  if (then_bgr.size() != now_bgr.size()) return check;
  const StillPatches patches(then_bgr);
  if (patches.count() < kLeastPieces) return check;
  const Moved moved = compare(patches, now_bgr);
  check.judged = true;
  const double still_px = kStill_working_px * patches.pxPerWorkingPx();
  const std::size_t changed = moved.displaced + moved.lost;
  const auto may_change = std::max<std::size_t>(
      kFewChanged, static_cast<std::size_t>(kShareChanged * static_cast<double>(patches.count())));
  if (2 * moved.lost > patches.count()) {
    check.sentence =
        "The picture is hardly that of the scan: the camera, the light or the whole place is "
        "another.";
  } else if (moved.camera_px > still_px) {
    check.sentence =
        formatted("The camera was moved since: the picture is %.1f px off.", moved.camera_px);
  } else if (changed > may_change) {
    check.sentence = formatted(
        "Object or table do not stand as they stood: %zu of %zu places in the picture changed.",
        changed, patches.count());
  } else {
    check.same = true;
    check.sentence = "Camera, table and object stand as they stood.";
  }
  return check;
}

Result<std::optional<double>> tableAngleIn(const cv::Mat& picture_bgr, const ScanStore& store,
                                           const Task& task) {
  const Calibration& calibration = store.calibration();
  const ViewSpots now = findSpots(greyOf(picture_bgr));
  const std::size_t count = store.views().size();
  const std::size_t stride = std::max<std::size_t>(1, count / kViewsTried);
  std::vector<double> angles_rad;
  for (std::size_t back = 0; back < count; back += stride) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(back) / static_cast<double>(count),
                "Finding out where the table stands");
    const CapturedView& view = store.views()[count - 1 - back];
    const auto frame = store.readView(view);
    if (!frame) return frame.error();
    if ((*frame)->image_bgr.size() != picture_bgr.size()) return std::optional<double>();
    const auto turn_rad = turnBetween(findSpots(greyOf((*frame)->image_bgr)), now, calibration);
    if (turn_rad) angles_rad.push_back(view.table_angle_rad + *turn_rad);
  }
  return agreed(angles_rad);
}

}  // namespace gyre
