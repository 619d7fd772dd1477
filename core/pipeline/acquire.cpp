// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/acquire.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/pipeline/control_watch.h"
#include "core/pipeline/measured_turntable.h"
#include "core/pipeline/settling.h"
#include "core/pipeline/sharpness.h"
#include "core/scan/picture_size.h"

namespace gyre {
namespace {

// The way before the first view: takes up the play of gears and belts, so that every view is
// reached from the same side.
constexpr double kPreRoll_rad = radFromDeg(3.0);

// The camera is asked for its controls in every so many views, and in the last one.
constexpr int kViewsBetweenLooks = 10;
// A picture that is so late was held up by something: its camera was lost and came back.
constexpr double kLate_s = 6.0;

double viewAngle(const ScanSettings& settings, int view) {
  return settings.start_angle_rad + kTurn_rad * view / settings.views;
}

std::vector<int> missingViews(const ScanStore& store) {
  std::vector<char> captured(static_cast<std::size_t>(store.settings().views), 0);
  for (const CapturedView& view : store.views())
    captured.at(static_cast<std::size_t>(view.view)) = 1;
  std::vector<int> missing;
  for (int view = 0; view < store.settings().views; ++view) {
    if (captured[static_cast<std::size_t>(view)] == 0) missing.push_back(view);
  }
  return missing;
}

std::string stageText(int view, int views) {
  return "View " + std::to_string(view + 1) + " of " + std::to_string(views);
}

// What happens with the camera while the views are taken, kept with the scan.
class CameraLog {
 public:
  CameraLog(Camera& camera, ScanStore& store)
      : camera_(camera), store_(store), watch_(store.settings().camera_controls) {}

  Result<void> noteWait(int view, double waited_s) {
    if (waited_s < kLate_s) return {};
    return store_.addRemark(view, "The camera kept view " + std::to_string(view + 1) +
                                      " waiting for " + std::to_string(std::lround(waited_s)) +
                                      " s; the table stood meanwhile.");
  }

  Result<void> noteControls(int view) {
    if (view % kViewsBetweenLooks != 0 && view + 1 != store_.settings().views) return {};
    const auto now = camera_.readControls();
    if (!now) return {};  // its next picture will tell
    for (const std::string& sentence : watch_.look(now->controls, view)) {
      if (auto kept = store_.addRemark(view, sentence); !kept) return kept;
    }
    return {};
  }

 private:
  Camera& camera_;
  ScanStore& store_;
  ControlWatch watch_;
};

Result<void> acquireMissing(Turntable& turntable, Camera& camera, ScanStore& store,
                            const std::function<void(const FramePtr&)>& on_view, const Task& task) {
  const ScanSettings settings = store.settings();
  const std::vector<int> missing = missingViews(store);
  if (missing.empty()) return {};
  const Task silent(task.stopToken());
  const CalibratedTurntable known = measuredTurntable(turntable.info(), store.calibrationRecord());
  takeUpBacklash(turntable, known.backlash_rad);
  Settling settling(known.settle_s);
  CameraLog log(camera, store);
  const double first_rad = viewAngle(settings, missing.front());
  if (const auto moved = turntable.moveTo(first_rad - kPreRoll_rad, silent); !moved) return moved;
  for (const int view : missing) {
    task.report(static_cast<double>(view) / settings.views, stageText(view, settings.views));
    const auto moved = turntable.moveTo(viewAngle(settings, view), silent);
    if (!moved) return moved;
    const double stood_s = steadySeconds();
    const auto picture = settling.grabStill(camera, stood_s, silent);
    if (!picture) return picture.error();
    const double waited_s = steadySeconds() - stood_s;
    const cv::Mat& image = (*picture)->image_bgr;
    if (auto fits = checkCalibratedSize({image.cols, image.rows}, store.calibration().camera,
                                        "The camera's pictures have");
        !fits) {
      return fits;
    }
    Frame frame = **picture;
    frame.view = view;
    frame.name = viewFileName(view);
    frame.table_angle_rad = turntable.angleRad();
    const double sharpness = sharpnessOf(frame.image_bgr);
    if (const auto kept = store.addView(frame, turntable.steps(), sharpness); !kept) return kept;
    if (auto noted = log.noteWait(view, waited_s); !noted) return noted;
    if (auto noted = log.noteControls(view); !noted) return noted;
    on_view(std::make_shared<const Frame>(std::move(frame)));
  }
  task.report(1.0, "All views are captured");
  return {};
}

}  // namespace

Result<void> acquire(Turntable& turntable, Camera& camera, ScanStore& store,
                     const std::function<void(const FramePtr&)>& on_view, const Task& task) {
  Result<void> done = acquireMissing(turntable, camera, store, on_view, task);
  if (!done) turntable.stop();
  return done;
}

}  // namespace gyre
