// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibration_controller.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "app/calibration_run.h"
#include "app/count_anew.h"
#include "app/print_target.h"
#include "core/calib/match/from_clicks.h"
#include "core/calib/match/target_preview.h"
#include "core/calib/match/target_sketch.h"
#include "core/calib/targets/ruler_scale.h"
#include "core/calib/targets/standard_targets.h"
#include "core/io/calibration_record_file.h"
#include "core/io/target_file.h"
#include "core/pipeline/check_before_scan.h"
#include "core/pipeline/exposure.h"
#include "core/pipeline/sharpness.h"
#include "core/pipeline/target_finder.h"

namespace gyre {
namespace {

Result<Target> readChosen(const TargetChoice& choice) {
  const std::string word = choice.word.toStdString();
  if (word.ends_with(".json")) return readTarget(word);
  auto standard = standardTarget(word);
  if (!standard) return standard.error();
  return std::move(standard->target);
}

Result<Target> asPrinted(const TargetChoice& choice) {
  auto target = readChosen(choice);
  if (!target || !choice.ruler_right_mm || !choice.ruler_down_mm) return target;
  return scaledByRulers(*target, {*choice.ruler_right_mm, *choice.ruler_down_mm});
}

Result<void> makeFolderOf(const std::filesystem::path& file) {
  std::error_code problem;
  const auto folder = file.parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, problem);
  if (!problem) return {};
  return Error{Error::Code::kIo, "The folder \"" + folder.string() + "\" cannot be made.",
               "Save the calibration where you may write."};
}

}  // namespace

struct CalibrationController::Chosen {
  TargetChoice choice;
  Target target;
  TargetSketch sketch;
  CalibrateOptions options;
};

CalibrationController::CalibrationController(DeviceSession& devices, QObject* parent)
    : QObject(parent), devices_(devices), look_jobs_("gyre-look") {}

void CalibrationController::offerTargets() {
  std::vector<TargetOffer> offers;
  for (const std::string& name : standardTargetNames()) {
    const auto standard = standardTarget(name);
    if (!standard) continue;
    offers.push_back({QString::fromStdString(name), QString::fromStdString(standard->title),
                      QString::fromStdString(standard->purpose)});
  }
  Q_EMIT targetsOffered(offers);
}

void CalibrationController::chooseTarget(const TargetChoice& choice) {
  auto chosen = std::make_shared<Chosen>();
  chosen->choice = choice;
  const std::optional<CameraModel> lens = choice.keep_lens ? lens_ : std::nullopt;
  cancelHand();
  look_jobs_.start(
      [chosen, lens](const Task&) -> Result<void> {
        auto target = asPrinted(chosen->choice);
        if (!target) return target.error();
        const bool measured = chosen->choice.ruler_right_mm && chosen->choice.ruler_down_mm;
        auto options = optionsFor(*target, measured, lens);
        if (!options) return options.error();
        chosen->target = std::move(target).value();
        chosen->options = std::move(options).value();
        chosen->sketch = sketchOf(chosen->target);
        return {};
      },
      [this, chosen, lens](const Result<void>& outcome) {
        shown_ = {};
        shown_.camera = lens;
        if (outcome) {
          chosen_ = chosen;
          Q_EMIT targetReady(chosen->sketch);
        } else {
          chosen_.reset();
          Q_EMIT targetRefused(outcome.error());
        }
      });
}

void CalibrationController::knowLens(const CameraModel& lens) { lens_ = lens; }

void CalibrationController::beginHand() {
  if (!chosen_ || chosen_->sketch.to_click.empty() || turning_) return;
  picks_.emplace();
  Q_EMIT picksChanged({});
  Q_EMIT cornerAsked(0);
}

void CalibrationController::cancelHand() {
  if (!picks_) return;
  picks_.reset();
  Q_EMIT cornerAsked({});
}

void CalibrationController::pick(const Eigen::Vector2d& pixel) {
  if (!picks_ || !newest_) return;
  picks_->push_back(pixel);
  Q_EMIT picksChanged(*picks_);
  if (picks_->size() < chosen_->sketch.to_click.size()) {
    Q_EMIT cornerAsked(static_cast<int>(picks_->size()));
  } else {
    useClicks();
  }
}

void CalibrationController::useClicks() {
  std::vector<CornerClick> clicks;
  for (std::size_t i = 0; i < picks_->size(); ++i) {
    clicks.push_back({chosen_->sketch.to_click[i], (*picks_)[i]});
  }
  cancelHand();
  auto found = std::make_shared<FoundTarget>();
  look_jobs_.start(
      [found, clicks, frame = newest_, chosen = chosen_,
       lens = shown_.camera](const Task&) -> Result<void> {
        ClickOptions options;
        options.camera = lens;
        auto shown = targetFromClicks(frame->image_bgr, chosen->target, clicks, options);
        if (!shown) return shown.error();
        *found = std::move(shown).value();
        return {};
      },
      [this, found](const Result<void>& outcome) {
        if (!outcome) {
          TargetSight sight;
          sight.sentence = outcome.error().sentence();
          Q_EMIT sightSeen(sight);
          return;
        }
        shown_.camera = found->camera;
        shown_.expected_cam_from_target = found->cam_from_target;
      });
}

void CalibrationController::print(const QString& word, const QString& page, const QString& folder) {
  const auto target = standardTarget(word.toStdString());
  const auto size = pageSize(page.toStdString());
  if (!target || !size) {
    Q_EMIT failed({Error::Code::kInvalidInput, "There is no sheet to print for this target.",
                   "Choose one of the program's own targets."});
    return;
  }
  const QString file = folder + '/' + word + ".pdf";
  look_jobs_.start([target = *target, size = *size, folder = folder.toStdString()](
                       const Task&) { return printTarget(target, size, folder); },
                   [this, file](const Result<void>& written) {
                     if (written) {
                       Q_EMIT printed(file);
                     } else {
                       Q_EMIT failed(written.error());
                     }
                   });
}

void CalibrationController::watch(WizardStep step) {
  if (step != WizardStep::kPlace) cancelHand();
  watched_ = step;
  loadTable();
}

// In a simulated room nobody else has hands to put something on the table.
void CalibrationController::loadTable() {
  if (devices_.isOpen() && devices_.rig()->room) {
    devices_.rig()->room->setTable(TableLoad::kObject);
  }
}

void CalibrationController::watchFocus() {
  watches_focus_ = true;
  sharpest_ = 0.0;
  loadTable();
}

void CalibrationController::stopWatching() {
  watched_.reset();
  cancelHand();
}

void CalibrationController::lookAt(const FramePtr& frame) {
  newest_ = frame;
  if (turning_ || picks_ || look_jobs_.busy()) return;
  if (watches_focus_) {
    lookAtFocus(frame);
    return;
  }
  if (!watched_) return;
  if (*watched_ == WizardStep::kPlace && chosen_) lookForTarget(frame);
}

void CalibrationController::lookAtFocus(const FramePtr& frame) {
  struct Seen {
    double sharpness = 0.0;
    Exposure exposure;
  };
  auto seen = std::make_shared<Seen>();
  look_jobs_.start(
      [seen, frame](const Task&) -> Result<void> {
        seen->sharpness = sharpnessOf(frame->image_bgr);
        seen->exposure = exposureOf(frame->image_bgr);
        return {};
      },
      [this, seen](const Result<void>& outcome) {
        if (!outcome) return;
        sharpest_ = std::max(sharpest_, seen->sharpness);
        FocusFacts facts;
        facts.sharpness = sharpest_ > 0.0 ? seen->sharpness / sharpest_ : 0.0;
        facts.too_bright = seen->exposure.too_bright;
        facts.too_dark = seen->exposure.too_dark;
        facts.advice = QString::fromStdString(exposureAdvice(seen->exposure));
        Q_EMIT focusSeen(facts);
      });
}

void CalibrationController::lookForTarget(const FramePtr& frame) {
  auto sight = std::make_shared<TargetSight>();
  look_jobs_.start(
      [sight, frame, chosen = chosen_, shown = shown_](const Task& task) -> Result<void> {
        *sight = previewTarget(frame->image_bgr, chosen->target, shown, task);
        return {};
      },
      [this, sight](const Result<void>& outcome) {
        if (outcome && watched_ == WizardStep::kPlace && !picks_) Q_EMIT sightSeen(*sight);
      });
}

void CalibrationController::turn() {
  if (turning_ || !chosen_) return;
  if (!devices_.mayMove()) {
    Q_EMIT turnFailed({Error::Code::kRejected, "The table was not moved.",
                       "Say first that this device is your turntable (step 1)."});
    return;
  }
  turning_ = true;
  auto outcome = std::make_shared<CalibrationOutcome>();
  cancelHand();
  CalibrationWatcher watcher;
  watcher.on_picture = [this, chosen = chosen_](const SightedPicture& picture) {
    TargetSight sight;
    sight.sentence = picture.reason;
    if (picture.view) {
      for (const PointSighting& seen : picture.view->sightings) {
        sight.found_px.emplace_back(seen.pixel.cast<float>());
      }
    }
    QMetaObject::invokeMethod(
        this, [this, frame = picture.frame, sight] { Q_EMIT pictureTaken(frame, sight); },
        Qt::QueuedConnection);
  };
  devices_.runAlone(
      [rig = devices_.rig(), chosen = chosen_, shown = shown_, watcher,
       outcome](const Task& task) -> Result<void> {
        if (const auto counted = countAnewIfLost(*rig->turntable); !counted) return counted;
        auto calibrated =
            calibrateLive({*rig->turntable, *rig->camera}, soughtTarget(chosen->target, shown),
                          chosen->options, watcher, task);
        if (!calibrated) return calibrated.error();
        *outcome = std::move(calibrated).value();
        return {};
      },
      [this, outcome](const Result<void>& ended) {
        turning_ = false;
        if (ended) {
          outcome_ = outcome;
          Q_EMIT measured(outcome_);
        } else if (ended.error().code == Error::Code::kCancelled) {
          Q_EMIT stopped();
        } else {
          Q_EMIT turnFailed(ended.error());
        }
      });
}

void CalibrationController::stop() {
  if (turning_) devices_.requestStop();
}

void CalibrationController::save(const std::filesystem::path& file) {
  if (!outcome_) return;
  look_jobs_.start(
      [outcome = outcome_, file](const Task&) -> Result<void> {
        if (auto made = makeFolderOf(file); !made) return made;
        if (auto kept = keepReference(file, *outcome); !kept) return kept;
        return writeCalibrationRecord(file, recordOf(*outcome, nowUtcText()));
      },
      [this, file](const Result<void>& written) {
        if (written) {
          Q_EMIT saved(QString::fromStdString(file.string()));
        } else {
          Q_EMIT failed(written.error());
        }
      });
}

}  // namespace gyre
