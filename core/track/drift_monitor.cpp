// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/drift_monitor.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/track/drift_sentence.h"

namespace gyre {
namespace {

// By then the platter's texture has moved off its place, all but what lies next to the axis.
constexpr double kElsewhere_rad = radFromDeg(12.0);
constexpr std::size_t kLeastPieces = 8;
constexpr double kTolerance_working_px = 0.6;
// Of all pieces that are found; before it is known which of them stand still.
constexpr double kShareOfFound = 0.6;
// Of the pieces that stand still: most of the background.
constexpr double kShareOfStill = 0.5;
constexpr double kShareOfViews = 0.5;
// Interpolation shifts every place by up to this; it does not average out.
constexpr double kInterpolation_working_px = 0.01;
// A motion that is known no better than this tells nothing.
constexpr double kMostSigma_px = 0.5;

// The motion that most of the chosen pieces share, and who shares it by piece.
struct Shared {
  std::optional<SharedMotion> motion;
  std::vector<bool> shares;
  std::size_t found = 0;
};

Shared sharedBy(const StillPatches& patches, const StillPatches::Motions& motions,
                const std::vector<bool>* chosen) {
  Shared result;
  result.shares.assign(motions.size(), false);
  std::vector<ImageMotion> given;
  std::vector<std::size_t> piece;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i] || (chosen != nullptr && !(*chosen)[i])) continue;
    given.push_back({patches.placeOf(i), *motions[i]});
    piece.push_back(i);
  }
  result.found = given.size();
  if (given.size() < kLeastPieces) return result;
  auto motion = sharedMotion(given, kTolerance_working_px * patches.pxPerWorkingPx());
  if (!motion || motion->sharing < kLeastPieces) return result;
  for (std::size_t i = 0; i < piece.size(); ++i) result.shares[piece[i]] = motion->shares[i];
  result.motion = std::move(motion);
  return result;
}

// Before it is known what stands still, most of what is found must move alike.
Shared sharedByFound(const StillPatches& patches, const StillPatches::Motions& motions) {
  Shared shared = sharedBy(patches, motions, nullptr);
  if (shared.motion && static_cast<double>(shared.motion->sharing) <
                           kShareOfFound * static_cast<double>(shared.found)) {
    shared.motion.reset();
  }
  return shared;
}

ViewDrift driftOf(const SharedMotion& motion, const StillPatches& patches,
                  const DriftOptions& options) {
  ViewDrift drift;
  drift.px = motion.rmsPx(patches.pictureSizePx());
  drift.sigma_px = std::hypot(motion.rmsSigmaPx(patches.pictureSizePx()),
                              kInterpolation_working_px * patches.pxPerWorkingPx());
  drift.moved = drift.px > std::max(options.least_px, options.least_sigma * drift.sigma_px);
  drift.judged = drift.moved || drift.sigma_px <= kMostSigma_px;
  return drift;
}

}  // namespace

void DriftMonitor::addFrame(const Frame& frame) {
  View view;
  view.view = frame.view;
  if (!patches_) {
    patches_.emplace(frame.image_bgr);
    first_angle_rad_ = frame.table_angle_rad;
    last_ = {};
  }
  const double turned_rad =
      std::abs(std::remainder(frame.table_angle_rad - first_angle_rad_, kTurn_rad));
  view.turned_elsewhere = turned_rad > kElsewhere_rad;
  const Eigen::Vector2d size_px(frame.image_bgr.cols, frame.image_bgr.rows);
  if (size_px == patches_->pictureSizePx()) measure(frame.image_bgr, view);
  views_.push_back(std::move(view));
}

// Looks near where the last view was first, and everywhere when the scene is not there any more.
void DriftMonitor::measure(const cv::Mat& image_bgr, View& view) {
  const cv::Mat grey = patches_->workingGrey(image_bgr);
  view.motions = patches_->motionsNear(grey, last_);
  Shared shared = sharedByFound(*patches_, view.motions);
  const std::vector<bool> still = stillPieces();
  const auto known = static_cast<double>(std::count(still.begin(), still.end(), true));
  const bool lost = !shared.motion || static_cast<double>(shared.motion->sharing) < 0.5 * known;
  if (lost && view.turned_elsewhere) {
    StillPatches::Motions anywhere = patches_->motionsAnywhere(grey);
    Shared wider = sharedByFound(*patches_, anywhere);
    if (wider.motion && (!shared.motion || wider.motion->sharing > shared.motion->sharing)) {
      view.motions = std::move(anywhere);
      shared = std::move(wider);
    }
  }
  view.shares = std::move(shared.shares);
  view.shared = std::move(shared.motion);
  if (view.shared) last_ = *view.shared;
}

std::vector<bool> DriftMonitor::stillPieces() const {
  std::vector<bool> still(patches_ ? patches_->count() : 0, false);
  std::vector<int> shared_in(still.size(), 0);
  int views = 0;
  for (const View& view : views_) {
    if (!view.turned_elsewhere || !view.shared) continue;
    ++views;
    for (std::size_t i = 0; i < still.size(); ++i) shared_in[i] += view.shares[i] ? 1 : 0;
  }
  for (std::size_t i = 0; i < still.size(); ++i) {
    still[i] = views > 0 && shared_in[i] >= kShareOfViews * views;
  }
  return still;
}

ViewDrift DriftMonitor::judged(const View& view, const std::vector<bool>& still) const {
  ViewDrift drift;
  const auto count = static_cast<double>(std::count(still.begin(), still.end(), true));
  const Shared shared = sharedBy(*patches_, view.motions, &still);
  if (shared.motion && static_cast<double>(shared.motion->sharing) >= kShareOfStill * count) {
    drift = driftOf(*shared.motion, *patches_, options_);
  }
  drift.view = view.view;
  return drift;
}

ViewDrift DriftMonitor::latest() const {
  if (views_.size() < 2) return {};
  return judged(views_.back(), stillPieces());
}

DriftReport DriftMonitor::report() const {
  DriftReport report;
  const std::vector<bool> still = stillPieces();
  for (const View& view : views_) report.views.push_back(judged(view, still));
  if (views_.size() > 1) report.sentence = driftSentence(report.views, options_.least_px);
  return report;
}

ViewDrift pictureDrift(const cv::Mat& reference_bgr, const cv::Mat& image_bgr,
                       const DriftOptions& options) {
  if (reference_bgr.size() != image_bgr.size()) return {};
  const StillPatches patches(reference_bgr);
  const cv::Mat grey = patches.workingGrey(image_bgr);
  Shared shared = sharedByFound(patches, patches.motionsNear(grey, {}));
  Shared wider = sharedByFound(patches, patches.motionsAnywhere(grey));
  if (wider.motion && (!shared.motion || wider.motion->sharing > shared.motion->sharing)) {
    shared = std::move(wider);
  }
  return shared.motion ? driftOf(*shared.motion, patches, options) : ViewDrift{};
}

}  // namespace gyre
