// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/take_up_scan.h"

#include <optional>
#include <utility>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/recorded_camera.h"
#include "core/pipeline/control_watch.h"
#include "core/pipeline/find_view.h"
#include "core/pipeline/measured_turntable.h"
#include "core/pipeline/settling.h"
#include "core/pipeline/stands_as_before.h"

namespace gyre {
namespace {

// Views are reached from the same side as in the scan, past the play of gears and belts.
constexpr double kPreRoll_rad = radFromDeg(3.0);
constexpr const char* kPutBack =
    "Put everything back as it stood, or turn the table by hand to where the scan began; else "
    "begin "
    "a new scan.";

Error standsElsewhere() {
  return {Error::Code::kRejected,
          "The camera sees none of the views of this scan, so nothing was moved.", kPutBack};
}

// Where the table stands, by one picture; and whether that picture is the very one of a view.
struct Place {
  std::optional<CapturedView> view;
  std::optional<double> angle_rad;
};

Result<Place> placeIn(const cv::Mat& picture_bgr, const ScanStore& store, const Task& task) {
  Place place;
  auto view = findView(picture_bgr, store, task.part(0.0, 0.3));
  if (!view) return view.error();
  place.view = *view;
  if (place.view) {
    place.angle_rad = place.view->table_angle_rad;
    return place;
  }
  auto angle_rad = tableAngleIn(picture_bgr, store, task.part(0.3, 0.8));
  if (!angle_rad) return angle_rad.error();
  place.angle_rad = *angle_rad;
  return place;
}

// A picture of the last captured view, after the table was turned back to it.
Result<FramePtr> lastViewAgain(const Rig& rig, const ScanStore& store, const Task& task) {
  const double angle_rad = store.views().back().table_angle_rad;
  const CalibratedTurntable known =
      measuredTurntable(rig.turntable->info(), store.calibrationRecord());
  takeUpBacklash(*rig.turntable, known.backlash_rad);
  if (auto moved = rig.turntable->moveTo(angle_rad - kPreRoll_rad, task); !moved) {
    return moved.error();
  }
  if (auto moved = rig.turntable->moveTo(angle_rad, task); !moved) return moved.error();
  return Settling(known.settle_s).grabStill(*rig.camera, steadySeconds(), task);
}

class TakingUp {
 public:
  TakingUp(const Rig& rig, const ScanStore& store, TakeUp how)
      : rig_(rig), store_(store), how_(how) {}

  Result<void> run(const Task& task);
  std::vector<std::string> remarks() && { return std::move(remarks_); }

 private:
  Result<void> object(const Error& error);
  Result<void> proveBy(const CapturedView& view, const FramePtr& picture);

  const Rig& rig_;
  const ScanStore& store_;
  const TakeUp how_;
  std::vector<std::string> remarks_;
};

// An objection ends it, or becomes a remark where somebody knows better.
Result<void> TakingUp::object(const Error& error) {
  if (how_ == TakeUp::kProve) return error;
  remarks_.push_back(error.what);
  return {};
}

Result<void> TakingUp::proveBy(const CapturedView& view, const FramePtr& picture) {
  const auto then = store_.readView(view);
  if (!then) return then.error();
  const StandsCheck check = standsAsBefore((*then)->image_bgr, picture->image_bgr);
  // Where there is little to look for, that no other view looks so must do.
  const bool looks_the_same = !somethingMoved((*then)->image_bgr, picture->image_bgr);
  if (check.same || (!check.judged && looks_the_same)) return {};
  return object({Error::Code::kRejected, check.sentence, kPutBack});
}

Result<void> TakingUp::run(const Task& task) {
  if (store_.views().empty()) return rig_.turntable->setAngle(store_.settings().start_angle_rad);
  const auto lens = sameLens(store_.settings().camera_controls, rig_.camera->info().controls);
  if (!lens) {
    if (auto allowed = object(lens.error()); !allowed) return allowed;
  }
  // Recorded pictures are those of the views: the last captured one is where it stands.
  if (auto* recorded = dynamic_cast<RecordedCamera*>(rig_.camera.get())) {
    recorded->goTo(store_.views().size() - 1);
  }
  const auto picture = rig_.camera->grabAfter(steadySeconds(), task);
  if (!picture) return picture.error();
  const auto place = placeIn((*picture)->image_bgr, store_, task);
  if (!place) return place.error();
  if (!place->angle_rad) {
    if (auto allowed = object(standsElsewhere()); !allowed) return allowed;
    return rig_.turntable->setAngle(store_.views().back().table_angle_rad);
  }
  if (auto set = rig_.turntable->setAngle(*place->angle_rad); !set) return set;
  if (place->view) return proveBy(*place->view, *picture);
  task.report(0.8, "Turning back to the last view");
  const auto again = lastViewAgain(rig_, store_, Task(task.stopToken()));
  if (!again) return again.error();
  return proveBy(store_.views().back(), *again);
}

}  // namespace

Result<std::vector<std::string>> takeUpScan(const Rig& rig, const ScanStore& store, TakeUp how,
                                            const Task& task) {
  TakingUp taking_up(rig, store, how);
  if (auto done = taking_up.run(task); !done) return done.error();
  return std::move(taking_up).remarks();
}

}  // namespace gyre
