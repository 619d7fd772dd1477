// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_turning.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/clock.h"
#include "core/base/formatted.h"
#include "core/calib/rig/turn_gauge.h"

namespace gyre {
namespace {

constexpr int kTries = 3;
// Motion that is certain enough to tell a ratio from.
constexpr double kSeen_sigma = 8.0;
constexpr double kSeen_rad = radFromDeg(0.3);
// From so far on the ratio's own error no longer matters for where the next move ends.
constexpr double kFarEnough_rad = radFromDeg(4.0);
// Equal moves that differ by more: the target slips, or the motor loses steps.
constexpr double kUneven = 0.25;
constexpr double kUnevenWorthTelling = 0.08;
constexpr double kPlayWorthTelling_rad = radFromDeg(0.15);
// Backlash is kept when it is as certain as this, and more than a usual motor's half step.
constexpr double kBacklash_sigma = 4.0;
constexpr double kSmallestBacklash_rad = radFromDeg(0.05);
// Of the way back the table must follow so much, or the play is not taken up yet.
constexpr double kFollowedShare = 0.25;
// What an unknown lens may make of a ratio of one.
constexpr double kAsToldShare = 0.04;

std::string degText(double angle_rad) { return formatted("%.2g\u00b0", degFromRad(angle_rad)); }

Error nothingMoves(double told_rad) {
  return {Error::Code::kRejected,
          "The table was told to turn by " + degText(told_rad) +
              " in all, and the camera sees the target stand still.",
          "Check the motor's power and its plug, and that the right axis is named."};
}

Error slips(const std::vector<double>& turned_rad) {
  std::string list;
  for (const double each_rad : turned_rad) list += (list.empty() ? "" : ", ") + degText(each_rad);
  return {Error::Code::kRejected,
          "The table turns unevenly: equal moves turned the target by " + list + ".",
          "Fix the target so that it cannot slip, lighten the load, or lower speed and "
          "acceleration so that the motor loses no steps."};
}

Error lostTarget(const Error& reason) {
  return {reason.code,
          "The target was lost from sight while the table made its first moves. " + reason.what,
          reason.advice +
              " It may help to turn the target so that a whole face looks at the "
              "camera at first."};
}

}  // namespace

Result<TargetSighting> sightTarget(Camera& camera, Settling& settling,
                                   const TargetFinder& find_target, const Task& task) {
  std::optional<Error> reason;
  for (int i = 0; i < kTries; ++i) {
    auto frame = settling.grabStill(camera, steadySeconds(), task);
    if (!frame) return frame.error();
    auto view = find_target((*frame)->image_bgr);
    if (view) return TargetSighting{*frame, std::move(*view)};
    reason = view.error();
    if (reason->code == Error::Code::kCancelled || task.stopRequested()) return cancelled();
  }
  return *reason;
}

// One search: what was told and seen so far.
class TurningFinder::Search {
 public:
  Search(TurningFinder& finder, const TurningOptions& options, const Task& task)
      : finder_(finder), options_(options), task_(task) {}

  Result<FoundTurning> run();

 private:
  struct Reading {
    double told_rad = 0.0;
    double turned_rad = 0.0;
    double sigma_rad = 0.0;
  };

  Result<void> begin();
  Result<void> turnBy(double told_rad);
  Result<void> turnUntilSeen();
  Result<void> turnEvenly();
  Result<void> turnBack();
  double ratio() const { return readings_.back().turned_rad / readings_.back().told_rad; }
  bool seen() const;
  std::vector<double> evenTurns() const;
  double evenRatio() const;
  double unevenness() const;  // of the equal moves, as a share of one of them
  FoundTurning conclude() const;
  void concludeBacklash(FoundTurning& found) const;

  TurningFinder& finder_;
  const TurningOptions& options_;
  const Task& task_;
  std::optional<TurnGauge> gauge_;
  double begin_rad_ = 0.0;
  double target_told_rad_ = 0.0;
  std::vector<Reading> readings_ = {{}};
  std::size_t first_even_ = 0;  // reading before the first of the equal moves
  std::size_t last_even_ = 0;   // reading after the last of them
};

Result<void> TurningFinder::Search::begin() {
  task_.report(0.0, "Looking at the target");
  begin_rad_ = finder_.turntable_.angleRad();
  const auto sighting =
      sightTarget(finder_.camera_, finder_.settling_, finder_.find_target_, task_);
  if (!sighting) return sighting.error();
  const cv::Mat& image = sighting->frame->image_bgr;
  auto gauge = TurnGauge::create(finder_.target_, sighting->view, {image.cols, image.rows});
  if (!gauge) return gauge.error();
  gauge_ = std::move(*gauge);
  return {};
}

// Told angles count from the beginning, so that rounding to motor steps does not add up.
Result<void> TurningFinder::Search::turnBy(double told_rad) {
  target_told_rad_ += told_rad;
  const Task silent(task_.stopToken());
  auto moved = finder_.turntable_.moveTo(begin_rad_ + target_told_rad_, silent);
  // A bad wire may lose a move. Told as a place, not as a way, it does no harm twice.
  if (!moved && moved.error().code == Error::Code::kTimeout) {
    moved = finder_.turntable_.moveTo(begin_rad_ + target_told_rad_, silent);
  }
  if (!moved) return moved;
  const auto sighting =
      sightTarget(finder_.camera_, finder_.settling_, finder_.find_target_, task_);
  if (!sighting) {
    return sighting.error().code == Error::Code::kTooFew ||
                   sighting.error().code == Error::Code::kNotFound ||
                   sighting.error().code == Error::Code::kInvalidInput
               ? lostTarget(sighting.error())
               : sighting.error();
  }
  const auto turned = gauge_->read(sighting->view);
  if (!turned) {
    return Error{Error::Code::kRejected, "The target does not turn with the table.",
                 "Stand it upright on the platter, and fix it so that it cannot slip or tip."};
  }
  readings_.push_back(
      {finder_.turntable_.angleRad() - begin_rad_, turned->angle_rad, turned->sigma_rad});
  if (finder_.watcher_) finder_.watcher_(readings_.back().told_rad, turned->angle_rad);
  return {};
}

bool TurningFinder::Search::seen() const {
  const Reading& last = readings_.back();
  return std::abs(last.turned_rad) > std::max(kSeen_rad, kSeen_sigma * last.sigma_rad) &&
         last.told_rad != 0.0;
}

Result<void> TurningFinder::Search::turnUntilSeen() {
  double next_rad = options_.first_told_rad;
  while (!seen() || std::abs(readings_.back().turned_rad) < kFarEnough_rad) {
    if (!seen() && target_told_rad_ >= options_.most_told_rad) {
      return nothingMoves(target_told_rad_);
    }
    task_.report(std::min(0.5, 0.05 * static_cast<double>(readings_.size())),
                 "Finding out how far the table turns: told " + degText(target_told_rad_) +
                     ", turned " + degText(readings_.back().turned_rad));
    if (const auto turned = turnBy(next_rad); !turned) return turned;
    next_rad *= 2.0;
    // Play in the gears makes the ratio look too small: half of what is allowed is aimed at.
    if (seen()) next_rad = std::min(next_rad, 0.5 * options_.most_turn_rad / std::abs(ratio()));
  }
  return {};
}

Result<void> TurningFinder::Search::turnEvenly() {
  first_even_ = readings_.size() - 1;
  const double told_rad = 0.5 * options_.most_turn_rad / std::abs(ratio());
  for (int i = 0; i < options_.even_moves; ++i) {
    task_.report(0.5 + 0.5 * i / options_.even_moves, "Looking whether the table turns evenly");
    if (const auto turned = turnBy(told_rad); !turned) return turned;
  }
  last_even_ = readings_.size() - 1;
  if (!(unevenness() < kUneven)) return slips(evenTurns());
  return {};
}

// Back twice and forward once. A table's own way of arriving from one side would hide its play.
Result<void> TurningFinder::Search::turnBack() {
  const double approach_rad = finder_.turntable_.approachRad();
  finder_.turntable_.setApproach(0.0);
  const double told_rad = options_.most_turn_rad / std::abs(evenRatio());
  Result<void> turned;
  for (const double by_rad : {-told_rad, -told_rad, told_rad}) {
    task_.report(0.95, "Looking for play in gears and belt");
    if (turned) turned = turnBy(by_rad);
  }
  finder_.turntable_.setApproach(approach_rad);
  return turned;
}

std::vector<double> TurningFinder::Search::evenTurns() const {
  std::vector<double> turned_rad;
  for (std::size_t i = first_even_ + 1; i <= last_even_; ++i) {
    turned_rad.push_back(readings_[i].turned_rad - readings_[i - 1].turned_rad);
  }
  return turned_rad;
}

double TurningFinder::Search::evenRatio() const {
  const Reading& from = readings_[first_even_];
  const Reading& to = readings_[last_even_];
  return (to.turned_rad - from.turned_rad) / (to.told_rad - from.told_rad);
}

// Against what each was told, which coarse motor steps make different.
double TurningFinder::Search::unevenness() const {
  const double mean_rad = (readings_[last_even_].turned_rad - readings_[first_even_].turned_rad) /
                          static_cast<double>(last_even_ - first_even_);
  double worst_rad = 0.0;
  for (std::size_t i = first_even_ + 1; i <= last_even_; ++i) {
    const double told_rad = readings_[i].told_rad - readings_[i - 1].told_rad;
    const double turned_rad = readings_[i].turned_rad - readings_[i - 1].turned_rad;
    worst_rad = std::max(worst_rad, std::abs(turned_rad - evenRatio() * told_rad));
  }
  return worst_rad / std::abs(mean_rad);
}

// The one motor place was reached going back first, and going forward last.
void TurningFinder::Search::concludeBacklash(FoundTurning& found) const {
  const Reading& forward = readings_.back();
  const Reading& back = readings_[readings_.size() - 3];
  const double way_rad = evenRatio() * (back.told_rad - readings_[last_even_].told_rad);
  const double followed_rad = back.turned_rad - readings_[last_even_].turned_rad;
  if (followed_rad / way_rad < kFollowedShare) {
    found.remarks.push_back("Gears or belt have more than " +
                            degText((1.0 - kFollowedShare) * options_.most_turn_rad) +
                            " of play: the table hardly followed when it was turned back. Tighten "
                            "them: places that are reached from the other side are not exact.");
    return;
  }
  const double lost_rad = std::abs(back.turned_rad - forward.turned_rad);
  const double sigma_rad = std::hypot(back.sigma_rad, forward.sigma_rad);
  if (lost_rad < std::max(kSmallestBacklash_rad, kBacklash_sigma * sigma_rad)) return;
  found.backlash_rad = lost_rad;
  found.backlash_sigma_rad = sigma_rad;
  found.remarks.push_back(
      formatted("Gears or belt have %.2f\u00b0 \u00b1 %.2f\u00b0 of play: every "
                "place is reached from the same side, past that.",
                degFromRad(lost_rad), degFromRad(sigma_rad)));
}

FoundTurning TurningFinder::Search::conclude() const {
  const Reading& from = readings_[first_even_];
  const Reading& to = readings_[last_even_];
  FoundTurning found;
  const double turned_rad = to.turned_rad - from.turned_rad;
  found.turned_over_told = evenRatio();
  found.sigma = std::hypot(to.sigma_rad, from.sigma_rad) / std::abs(turned_rad);
  found.turned_rad = readings_.back().turned_rad;
  concludeBacklash(found);
  // What had been told before the even moves, less what it would have turned without play.
  const double missing_rad =
      std::abs(found.turned_over_told) * from.told_rad - std::abs(from.turned_rad);
  const double doubt_rad =
      3.0 * std::hypot(from.sigma_rad, found.sigma * std::abs(from.turned_rad));
  if (missing_rad > std::max(kPlayWorthTelling_rad, doubt_rad)) {
    found.play_rad = missing_rad;
  }
  if (found.play_rad > 0.0 && found.backlash_rad == 0.0) {
    found.remarks.push_back("Gears or belt have " + degText(missing_rad) +
                            " of play: the table followed only after that. Scans turn one way "
                            "only, so it does no harm there.");
  }
  if (unevenness() > kUnevenWorthTelling) {
    found.remarks.emplace_back(
        "The table does not turn quite evenly: a load or a speed that the "
        "motor barely manages, or a target that moves on it.");
  }
  if (std::abs(found.turned_over_told - 1.0) < kAsToldShare) {
    found.turned_over_told = 1.0;
  } else {
    found.remarks.push_back(formatted(
        "For each degree it is told the table turns %.3g%s: this is put right.",
        std::abs(found.turned_over_told), found.turned_over_told < 0.0 ? " clockwise" : ""));
  }
  return found;
}

Result<FoundTurning> TurningFinder::Search::run() {
  if (const auto done = begin(); !done) return done.error();
  if (const auto done = turnUntilSeen(); !done) return done.error();
  if (const auto done = turnEvenly(); !done) return done.error();
  if (const auto done = turnBack(); !done) return done.error();
  task_.report(1.0, "The table's turning is known");
  return conclude();
}

Result<FoundTurning> TurningFinder::find(const TurningOptions& options, const Task& task) {
  Result<FoundTurning> found = Search(*this, options, task).run();
  if (!found) turntable_.stop();
  return found;
}

}  // namespace gyre
