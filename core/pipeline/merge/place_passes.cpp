// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/place_passes.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/base/median.h"
#include "core/mesh/surface_fit.h"
#include "core/pipeline/merge/match_spots.h"
#include "core/pipeline/merge/seen_through.h"
#include "core/pipeline/merge/surface_spots.h"

namespace gyre {
namespace {

constexpr double kApartShare = 0.02;       // of the size: places farther apart are not the same
constexpr double kToleranceShare = 0.008;  // of the size: spots of one place agree to this
constexpr double kLeastOverlap = 0.05;
constexpr double kMostResidualShare = 0.005;
constexpr double kMostSeenThrough = 0.1;

std::string nameOf(std::size_t pass) { return "pass-" + std::to_string(pass + 1); }

Error notPlaced(const PassInput& pass, const std::string& why) {
  return {Error::Code::kTooFew,
          "It could not be found how \"" + pass.folder.string() +
              "\" lies on the other passes: " + why + ".",
          "Check that all passes are of the same object, under the same light. Lay the object so "
          "that a good part of what one pass sees is seen by another, too, and that its texture is "
          "sharp; a pass in between, on its side, helps."};
}

// A pass laid on another by their spots.
struct Laid {
  std::size_t on = 0;
  SpotAgreement agreement;
};

class Placing {
 public:
  Placing(const std::vector<PassInput>& passes, std::vector<SurfaceSpots> spots)
      : passes_(passes), spots_(std::move(spots)), placed_(passes.size()) {
    placed_[0] = scanPass(0, {}, std::nullopt);
    size_mm_ = boundsOf(passes[0].mesh).diagonal();
  }

  // Places one more pass: that of which most spots agree with a placed one.
  Result<void> placeNext(const Task& task) {
    std::optional<std::size_t> chosen;
    Laid best;
    for (std::size_t moving = 0; moving < passes_.size(); ++moving) {
      if (placed_[moving]) continue;
      auto laid = layOnAny(moving, task);
      if (task.stopRequested()) return cancelled();
      if (!laid || laid->agreement.pairs.size() <= best.agreement.pairs.size()) continue;
      chosen = moving;
      best = std::move(*laid);
    }
    if (!chosen) return notPlaced(firstUnplaced(), "no spots of its surface were found on them");
    return fit(*chosen, best, task);
  }

  std::vector<ScanPass> take() {
    std::vector<ScanPass> all;
    all.reserve(placed_.size());
    for (auto& pass : placed_) all.push_back(std::move(*pass));
    return all;
  }

 private:
  const PassInput& firstUnplaced() const {
    const auto found = std::find(placed_.begin(), placed_.end(), std::nullopt);
    return passes_[static_cast<std::size_t>(found - placed_.begin())];
  }

  ScanPass scanPass(std::size_t pass, const Rigid3& merged_from_pass,
                    const std::optional<PassFit>& fit) const {
    return {nameOf(pass), passes_[pass].folder, passes_[pass].views.size(), merged_from_pass, fit};
  }

  std::optional<Laid> layOnAny(std::size_t moving, const Task& task) {
    std::optional<Laid> best;
    for (std::size_t on = 0; on < passes_.size(); ++on) {
      if (!placed_[on]) continue;
      const auto known = std::pair{on, moving};
      auto found = std::find_if(tried_.begin(), tried_.end(),
                                [&](const auto& each) { return each.first == known; });
      if (found == tried_.end()) {
        const std::vector<SpotPair> pairs =
            pairSpots(spots_[on], spots_[moving], kApartShare * size_mm_);
        tried_.push_back({known, agreeingMotion(pairs, kToleranceShare * size_mm_, task)});
        found = tried_.end() - 1;
      }
      if (!found->second) continue;
      if (best && best->agreement.pairs.size() >= found->second->pairs.size()) continue;
      best = Laid{on, *found->second};
    }
    return best;
  }

  Result<void> fit(std::size_t moving, const Laid& laid, const Task& task) {
    std::vector<PlacePair> pairs;
    pairs.reserve(laid.agreement.pairs.size());
    for (const SpotPair& pair : laid.agreement.pairs) pairs.push_back({pair.fixed, pair.moving});
    const PassInput& on = passes_[laid.on];
    const PassInput& pass = passes_[moving];
    const auto fitted = fitSurfaces({on.mesh, on.cloud}, {pass.mesh, pass.cloud}, pairs,
                                    laid.agreement.fixed_from_moving, task);
    if (!fitted && fitted.error().code == Error::Code::kCancelled) return fitted.error();
    if (!fitted) return notPlaced(pass, "too little of it overlaps with them");
    if (fitted->overlap < kLeastOverlap)
      return notPlaced(pass, "too little of it overlaps with them");
    if (fitted->residual_mm > kMostResidualShare * size_mm_) {
      return notPlaced(pass, "its surface does not fit theirs");
    }
    if (seenThroughShare(pass.cloud, fitted->fixed_from_moving, on) > kMostSeenThrough ||
        seenThroughShare(on.cloud, fitted->fixed_from_moving.inverse(), pass) > kMostSeenThrough) {
      return notPlaced(pass, "a part of it lies where others saw through");
    }
    std::vector<double> distances_mm;
    distances_mm.reserve(pairs.size());
    for (const PlacePair& pair : pairs) {
      distances_mm.push_back((fitted->fixed_from_moving * pair.moving - pair.fixed).norm());
    }
    const PassFit told{pairs.size(), median(std::move(distances_mm)), fitted->overlap,
                       fitted->residual_mm};
    const Rigid3 merged_from_pass = placed_[laid.on]->merged_from_pass * fitted->fixed_from_moving;
    placed_[moving] = scanPass(moving, merged_from_pass, told);
    return {};
  }

  const std::vector<PassInput>& passes_;
  std::vector<SurfaceSpots> spots_;
  std::vector<std::optional<ScanPass>> placed_;
  std::vector<std::pair<std::pair<std::size_t, std::size_t>, std::optional<SpotAgreement>>> tried_;
  double size_mm_ = 0.0;
};

}  // namespace

Result<std::vector<ScanPass>> placePasses(const std::vector<PassInput>& passes, const Task& task) {
  std::vector<SurfaceSpots> spots;
  const auto count = static_cast<double>(passes.size());
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const Task part =
        task.part(0.7 * static_cast<double>(i) / count, 0.7 * static_cast<double>(i + 1) / count);
    auto found = findSurfaceSpots(passes[i], part);
    if (!found) return found.error();
    spots.push_back(std::move(*found));
  }
  Placing placing(passes, std::move(spots));
  for (std::size_t i = 1; i < passes.size(); ++i) {
    task.report(0.7 + 0.3 * static_cast<double>(i - 1) / count, "Laying the passes on each other");
    if (const auto done = placing.placeNext(task.part(0.7, 1.0)); !done) return done.error();
  }
  return placing.take();
}

}  // namespace gyre
