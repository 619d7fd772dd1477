// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/find_unknowns.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/pipeline/find_angles.h"
#include "core/pipeline/find_camera.h"
#include "core/pipeline/match_pictures.h"
#include "core/pipeline/model_scale.h"
#include "core/pipeline/solve_camera.h"

namespace gyre {
namespace {

// As pairs of pictures tell an angle; the points tell it better.
constexpr double kFoundAngles_deg = 0.3;

std::string stepWords(const TurnSteps& steps) {
  return formatted("%.3f deg, %s seen from above%s", std::abs(degFromRad(steps.common_rad)),
                   steps.common_rad > 0.0 ? "counter-clockwise" : "clockwise",
                   steps.closed ? ", whole turns" : "");
}

std::string cameraWords(const SolvedCamera& camera) {
  return formatted("focal length %.1f +- %.1f px; features miss by %.3f px, %.3f before",
                   camera.focal_px, camera.focal_sigma_px, camera.rms_after_px,
                   camera.rms_before_px);
}

}  // namespace

Result<std::map<std::string, std::string>> findUnknowns(const UnknownRig& rig,
                                                        PreparedPictures& prepared,
                                                        ReconstructOptions& options,
                                                        Console& console, const Task& task) {
  std::map<std::string, std::string> found;
  const bool calibrated = prepared.calibration.calibration.cam_from_table.has_value();
  const bool angles_told = prepared.angles_told;
  if (!angles_told || !calibrated || rig.refine_camera) {
    const auto matched = matchPictures(prepared.views, task.part(0.0, 0.3));
    if (!matched) return matched.error();
    if (!calibrated) {
      const auto camera = findCamera(prepared, *matched, task.part(0.3, 0.4));
      if (!camera) return camera.error();
    }
    if (!angles_told) {
      const auto steps = findAngles(prepared, *matched);
      if (!steps) return steps.error();
      found["angles"] = "found in the pictures: " + stepWords(*steps);
      console.say("Steps of " + stepWords(*steps) +
                  formatted(", found in %zu matches.", steps->agreeing));
      options.recover.angle_freedom_deg =
          std::max(options.recover.angle_freedom_deg, kFoundAngles_deg);
    } else if (calibrated) {
      const auto turned = turnCamera(prepared, *matched, task.part(0.3, 0.4));
      if (!turned) return turned.error();
    }
  }
  if (!calibrated || rig.refine_camera) {
    const auto camera =
        solveCamera(prepared, options, {calibrated, angles_told}, task.part(0.4, 1.0));
    if (!camera) return camera.error();
    found["calibration"] = "told by the object: " + cameraWords(*camera);
    console.say("Camera and axis told by the object: " + cameraWords(*camera) + ".");
  }
  return found;
}

bool giveSize(const UnknownRig& rig, bool calibrated, PreparedPictures& prepared,
              Reconstruction& model, Console& console) {
  if (!rig.known_length_mm && calibrated) return true;
  const double length_mm = rig.known_length_mm.value_or(kUnknownSize_mm);
  CalibrationRecord& record = prepared.calibration;
  const double scale = scaleModel(model, record.calibration, length_mm);
  // What was said of the calibration that came is not true of one that is scaled.
  record.report.reset();
  record.covariance.reset();
  record.table_from_target.reset();
  if (!rig.known_length_mm) {
    console.say(
        "Its size is unknown: the longest line through the model is taken to be 100 mm. Name the "
        "true one with --known-length MM.");
    return false;
  }
  if (calibrated) {
    console.say(formatted("Made %.4g mm long, %.2f %% %s than the calibration says.", length_mm,
                          100.0 * std::abs(scale - 1.0), scale > 1.0 ? "more" : "less"));
  }
  return true;
}

}  // namespace gyre
