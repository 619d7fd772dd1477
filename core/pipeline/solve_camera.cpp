// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/solve_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/pipeline/model_scale.h"
#include "core/recover/self_calibration.h"

namespace gyre {
namespace {

// How well a calibration knows its focal length, and pictures alone. A share of it.
constexpr double kCalibratedFocal = 0.005;
constexpr double kUnknownFocal = 1.0;
// The same for the principal point; unknown, as a share of the picture's width.
constexpr double kCalibratedCentre_px = 1.0;
constexpr double kUnknownCentre = 0.01;
// The same for the first coefficient of distortion.
constexpr double kCalibratedK1 = 0.01;
constexpr double kUnknownK1 = 0.1;
// How far angles may be off that nobody told.
constexpr double kFoundAngles_rad = radFromDeg(1.0);
constexpr double kLeastAngles_rad = radFromDeg(0.001);  // of a motor that is believed

Result<SolvedCamera> solveOnce(PreparedPictures& prepared, const ReconstructOptions& options,
                               const CameraKnowledge& known, const Task& task) {
  auto features = reconstruct(prepared, options, {}, task.part(0.0, 0.9));
  if (!features) return features.error();
  std::vector<PixelTrack> tracks;
  tracks.reserve(features->cloud.points.size());
  for (std::size_t i = 0; i < features->cloud.points.size(); ++i) {
    tracks.push_back({std::move(features->sightings[i]), features->cloud.points[i].position});
  }
  ViewAngles angles;
  for (const PictureView& view : prepared.views) angles.told_rad.push_back(view.table_angle_rad);
  angles.start_rad = angles.told_rad;
  if (features->turning) {
    for (std::size_t i = 0; i < angles.start_rad.size(); ++i) {
      angles.start_rad[i] = features->turning->views[i].angle_rad;
    }
  }
  SelfCalibrationOptions solving;
  solving.centre_px = known.calibrated
                          ? kCalibratedCentre_px
                          : kUnknownCentre * prepared.calibration.calibration.camera.width_px;
  solving.focal_share = known.calibrated ? kCalibratedFocal : kUnknownFocal;
  solving.k1 = known.calibrated ? kCalibratedK1 : kUnknownK1;
  solving.angle_rad =
      known.angles_told ? std::max(radFromDeg(options.recover.angle_freedom_deg), kLeastAngles_rad)
                        : kFoundAngles_rad;
  auto solved =
      selfCalibrate(tracks, prepared.calibration.calibration, angles, solving, task.part(0.9, 1.0));
  if (!solved) return solved.error();
  if (!known.calibrated) {
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(tracks.size());
    for (const PixelTrack& track : tracks) positions.push_back(track.position_in_table);
    scaleCalibration(solved->calibration, placementOf(positions), kUnknownSize_mm);
  }
  // What was said of the calibration that came is not true of this one.
  prepared.calibration.calibration = solved->calibration;
  prepared.calibration.report.reset();
  prepared.calibration.covariance.reset();
  for (std::size_t i = 0; i < prepared.views.size(); ++i) {
    prepared.views[i].table_angle_rad = solved->angles_rad[i];
  }
  return SolvedCamera{solved->calibration.camera.fx, solved->focal_sigma_px, solved->rms_before_px,
                      solved->rms_after_px};
}

}  // namespace

Result<SolvedCamera> solveCamera(PreparedPictures& prepared, const ReconstructOptions& options,
                                 const CameraKnowledge& known, const Task& task) {
  ReconstructOptions features_only = options;
  features_only.cloud.point_spacing_px = 0.0;
  PreparedPictures better = prepared;
  const int rounds = known.calibrated ? 1 : 2;
  Result<SolvedCamera> refined = SolvedCamera{};
  for (int round = 0; round < rounds; ++round) {
    refined = solveOnce(
        better, features_only, known,
        task.part(static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds));
    if (!refined) return refined;
  }
  prepared = std::move(better);
  return refined;
}

}  // namespace gyre
