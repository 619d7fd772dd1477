// Finds out how far and which way a turntable turns for what it is told, by tiny moves.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/base/units.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"
#include "core/pipeline/settling.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre {

// What a picture shows of the target that stands on the table, or why it shows nothing.
using TargetFinder = std::function<Result<TargetView>(const cv::Mat& image_bgr)>;

struct TurningOptions {
  // The first move. With the largest ratio that is looked for, 50, it turns the table by 5 degrees.
  double first_told_rad = radFromDeg(0.1);
  // Told in all without any motion in the picture, after which the motor is said not to turn. With
  // the smallest ratio, 1/50, the table has then turned by one degree. [rad], > 0
  double most_told_rad = radFromDeg(51.0);
  // No move is told to turn further than this by what is known of the ratio. [rad], < 20 degrees
  double most_turn_rad = radFromDeg(8.0);
  // So many equal moves at the end, which show whether the table turns evenly. > 1
  int even_moves = 3;
};

struct FoundTurning {
  double turned_over_told = 1.0;     // negative: plus turned it clockwise, seen from above
  double sigma = 0.0;                // one standard deviation of its size, relative; lens aside
  double play_rad = 0.0;             // of gears or belt: turned away before the table followed
  double backlash_rad = 0.0;         // lost when it turns back; 0 when none is certain
  double backlash_sigma_rad = 0.0;   // one standard deviation of that
  double turned_rad = 0.0;           // in all; the table is left there
  std::vector<std::string> remarks;  // for the user, a sentence each
};

// Called after each move with what was told and what was seen, counted from the beginning.
using TurningWatcher = std::function<void(double told_rad, double turned_rad)>;

// Finds the ratio by moves in the firmware's positive direction: the first move is tiny, each next
// is twice the last until the camera sees the table turn; from then on no move is told to turn
// further than most_turn_rad. So for every ratio from 1/50 to 50, either way round, no move truly
// turns the table by more than 20 degrees. Speed and ramps are the device's.
//
// Then it turns back twice and forward once, to reach one motor place from both sides: what the
// pictures of it differ by is the backlash, whatever the motor's own errors.
//
// The ratio is right to a few percent, as the lens is not known yet, and is 1 exactly when it is
// that near. Nothing is changed in the device: give it to Turntable::correct().
//
// Fails when the target is not seen, when nothing moves, when the table turns unevenly or the
// target slips on it, and on every failure of a device; the table is then stopped.
class TurningFinder {
 public:
  TurningFinder(Turntable& turntable, Camera& camera, const Target& target,
                TargetFinder find_target)
      : turntable_(turntable),
        camera_(camera),
        target_(target),
        find_target_(std::move(find_target)) {}

  void watch(TurningWatcher watcher) { watcher_ = std::move(watcher); }

  Result<FoundTurning> find(const TurningOptions& options, const Task& task);

 private:
  class Search;

  Turntable& turntable_;
  Camera& camera_;
  const Target& target_;
  TargetFinder find_target_;
  TurningWatcher watcher_;
  Settling settling_;
};

// The target in a picture of the table at rest, tried a few times: a lamp may flicker, a hand
// may pass. Fails with the finder's own reason.
struct TargetSighting {
  FramePtr frame;
  TargetView view;
};
Result<TargetSighting> sightTarget(Camera& camera, Settling& settling,
                                   const TargetFinder& find_target, const Task& task);

}  // namespace gyre
