// Follows the table through a scan by a ring of markers that stays on its platter.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/pipeline/calibrate.h"
#include "core/scan/calibration_record.h"
#include "core/scan/drift.h"
#include "core/scan/frame.h"
#include "core/scan/turning.h"

namespace gyre {

// The ring of markers that the rig was calibrated with, which stays on the platter under objects.
// Nothing when it was calibrated with another target.
std::optional<Target> ringOf(const CalibrationRecord& record);

// Gives each frame the angle that the markers show, in place of the one the table was told: motors
// err, belts slip and steps get lost. The first frame that shows the ring stands where it was told,
// so that the table frame stays the scan's own. Tells, too, when the platter is not where turning
// alone would have it: then camera or table were pushed, and the markers no longer tell angles.
//
// When the ring does not lie where it was calibrated at the first sight of it, it is not used, and
// the sentence says so. One thread; frames in their order. Numbers: docs/algorithms/ring.md.
class PlatterRing {
 public:
  // Nothing when the record has no ring, or does not say where it lies.
  static std::optional<PlatterRing> of(const CalibrationRecord& record);

  // The frame with the angle at which its table stood; the picture itself is shared.
  FramePtr follow(const FramePtr& frame);

  // The frame of the same rig taken apart from the scan, such as the empty table's, likewise; but
  // it is no view of the scan. Before the first frame that showed the ring, it comes back as it is.
  FramePtr withSeenAngle(const FramePtr& frame) const;

  // Where one picture shows that the table stands, as the calibration counts its angle, (-pi, pi];
  // nothing when the ring is not seen well enough, or does not lie where it was calibrated.
  std::optional<double> angleIn(const cv::Mat& image_bgr) const;

  // How far the platter was off in each view; not judged where the ring was not seen.
  const std::vector<ViewDrift>& drift() const { return drift_; }

  TurningReport turning() const;

 private:
  PlatterRing(const CalibrationRecord& record, const Target& ring);

  struct Sight {
    double angle_rad = 0.0;  // the turn nearest to the told one
    double sigma_rad = 0.0;
    ViewDrift drift;
  };
  std::optional<Sight> look(const Frame& frame) const;
  void take(const Sight& sight, TurnedView& turned);
  static bool tellsAngle(const Sight& sight);

  SoughtTarget sought_;
  Calibration calibration_;
  std::vector<Eigen::Vector3d> points_in_table_;
  std::optional<double> misplaced_px_;  // so far off at its first sight: not used
  std::optional<double> zero_rad_;      // what the ring shows when the scan's angle is 0
  double off_rad_ = 0.0;                // of the last view that was seen: seen less told
  std::vector<TurnedView> turned_;
  std::vector<ViewDrift> drift_;
};

}  // namespace gyre
