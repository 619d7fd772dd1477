// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/platter_ring.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/calib/rig/ring_place.h"
#include "core/calib/targets/standard_targets.h"
#include "core/pipeline/target_finder.h"

namespace gyre {
namespace {

// Less is within what paper, glue and a bearing that wobbles do.
constexpr double kLeastMoved_px = 0.5;
constexpr double kLeastMoved_sigma = 5.0;
// Coarser than this, the motor's own count is the better angle.
constexpr double kMostSigma_rad = radFromDeg(0.05);
// No motor errs by so much; a table that is off by more lost steps, or was turned by hand.
constexpr double kOffCourse_rad = radFromDeg(1.0);

std::vector<Eigen::Vector3d> pointsInTable(const CalibrationRecord& record, const Target& ring) {
  std::vector<Eigen::Vector3d> points;
  for (const TargetPoint& point : pointsOf(ring)) points.push_back(point.position_in_target);
  if (record.points_in_target.size() == points.size()) points = record.points_in_target;
  for (Eigen::Vector3d& point : points) point = *record.table_from_target * point;
  return points;
}

FramePtr atAngle(const FramePtr& frame, double angle_rad) {
  auto turned = std::make_shared<Frame>(*frame);
  turned->table_angle_rad = angle_rad;
  return turned;
}

std::string turningSentence(const TurningReport& report, std::size_t seen) {
  const std::size_t views = report.views.size();
  std::string sentence =
      formatted("The markers on the platter gave the angle of %zu of %zu views. ", seen, views);
  const auto off = std::find_if(report.views.begin(), report.views.end(),
                                [](const TurnedView& each) { return each.off_course; });
  if (off == report.views.end()) {
    return sentence +
           formatted("The table stood within %.3f\u00b0 of where it was told to (rms %.3f\u00b0).",
                     degFromRad(report.worst_off_rad), degFromRad(report.rms_off_rad));
  }
  return sentence +
         formatted(
             "From view %d on, the table stood %.2f\u00b0 from where it was told to: it lost "
             "steps or was turned by hand. The points are measured at the true angles; to turn "
             "evenly, give the motor more current, or turn more slowly.",
             off->view + 1, degFromRad(std::abs(off->angle_rad - off->told_rad)));
}

}  // namespace

std::optional<Target> ringOf(const CalibrationRecord& record) {
  const auto standard = standardTarget(record.target);
  if (!standard || !standard->target.faces.empty()) return std::nullopt;
  return standard->target;
}

std::optional<PlatterRing> PlatterRing::of(const CalibrationRecord& record) {
  const auto ring = ringOf(record);
  if (!ring || !record.table_from_target || !record.calibration.cam_from_table) {
    return std::nullopt;
  }
  return PlatterRing(record, *ring);
}

PlatterRing::PlatterRing(const CalibrationRecord& record, const Target& ring)
    : sought_(soughtTarget(ring)),
      calibration_(record.calibration),
      points_in_table_(pointsInTable(record, ring)) {}

std::optional<PlatterRing::Sight> PlatterRing::look(const Frame& frame) const {
  const auto view = sought_.find(frame.image_bgr);
  if (!view) return std::nullopt;
  const auto place = placeOfRing(calibration_, points_in_table_, *view);
  if (!place) return std::nullopt;
  Sight sight;
  // The picture tells the angle but not how many turns; the count does.
  const double expected_rad = zero_rad_.value_or(0.0) + frame.table_angle_rad + off_rad_;
  sight.angle_rad = expected_rad + std::remainder(place->angle_rad - expected_rad, kTurn_rad);
  sight.sigma_rad = place->sigma_rad;
  sight.drift.view = frame.view;
  sight.drift.judged = true;
  sight.drift.px = place->px;
  sight.drift.sigma_px = place->sigma_px;
  sight.drift.moved = place->px > std::max(kLeastMoved_px, kLeastMoved_sigma * place->sigma_px);
  return sight;
}

FramePtr PlatterRing::follow(const FramePtr& frame) {
  TurnedView turned;
  turned.view = frame->view;
  turned.name = frame->name;
  turned.told_rad = frame->table_angle_rad;
  drift_.push_back({});
  drift_.back().view = frame->view;
  if (!misplaced_px_) {
    if (const auto sight = look(*frame)) take(*sight, turned);
  }
  turned.angle_rad = turned.told_rad + off_rad_;
  turned_.push_back(turned);
  return atAngle(frame, turned.angle_rad);
}

void PlatterRing::take(const Sight& sight, TurnedView& turned) {
  if (!zero_rad_ && sight.drift.moved) {
    misplaced_px_ = sight.drift.px;
    return;
  }
  drift_.back() = sight.drift;
  turned.seen = tellsAngle(sight);
  if (!turned.seen) return;
  if (!zero_rad_) zero_rad_ = sight.angle_rad - turned.told_rad;
  off_rad_ = sight.angle_rad - *zero_rad_ - turned.told_rad;
  turned.sigma_rad = sight.sigma_rad;
  turned.off_course = std::abs(off_rad_) > kOffCourse_rad;
}

bool PlatterRing::tellsAngle(const Sight& sight) {
  return !sight.drift.moved && sight.sigma_rad <= kMostSigma_rad;
}

FramePtr PlatterRing::withSeenAngle(const FramePtr& frame) const {
  if (!zero_rad_) return frame;
  const auto sight = look(*frame);
  if (!sight || !tellsAngle(*sight)) return frame;
  return atAngle(frame, sight->angle_rad - *zero_rad_);
}

std::optional<double> PlatterRing::angleIn(const cv::Mat& image_bgr) const {
  Frame frame;
  frame.image_bgr = image_bgr;
  const auto sight = look(frame);
  if (!sight || !tellsAngle(*sight)) return std::nullopt;
  return std::remainder(sight->angle_rad, kTurn_rad);
}

TurningReport PlatterRing::turning() const {
  TurningReport report;
  report.views = turned_;
  if (misplaced_px_) {
    report.sentence = formatted(
        "The markers on the platter do not lie where they were calibrated (%.1f px off), so the "
        "angles are the motor's own. Calibrate with the ring once more.",
        *misplaced_px_);
    return report;
  }
  std::size_t seen = 0;
  double squares = 0.0;
  for (const TurnedView& each : turned_) {
    if (!each.seen) continue;
    ++seen;
    const double off_rad = std::abs(each.angle_rad - each.told_rad);
    squares += off_rad * off_rad;
    report.worst_off_rad = std::max(report.worst_off_rad, off_rad);
  }
  if (seen == 0) {
    report.sentence =
        "The ring of markers was seen in no view, so the angles are the motor's own. Keep the "
        "platter's front in the picture, in focus and lit.";
    return report;
  }
  report.rms_off_rad = std::sqrt(squares / static_cast<double>(seen));
  report.sentence = turningSentence(report, seen);
  return report;
}

}  // namespace gyre
