// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/write_results.h"

#include <string>
#include <utility>
#include <vector>

#include <opencv2/core/version.hpp>

#include "core/base/clock.h"
#include "core/base/formatted.h"
#include "core/geometry/turntable_pose.h"
#include "core/io/calibration_record_file.h"
#include "core/io/fingerprint.h"
#include "core/io/obj.h"
#include "core/io/ply.h"
#include "core/io/result_folder.h"
#include "core/io/sightings_file.h"
#include "core/io/silhouettes_file.h"
#include "core/io/visibility_file.h"
#include "core/pipeline/make_mesh.h"
#include "core/pipeline/report_page.h"
#include "core/pipeline/sights.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEnoughPoints = 500;
// With steps wider than 15 degrees, most features turn away before they are seen again.
constexpr std::size_t kFewViews = 24;

Report completed(Report report, const Reconstruction& reconstruction) {
  report.points = reconstruction.cloud.points.size();
  report.observations = reconstruction.observations;
  report.rms_px = reconstruction.rms_px;
  report.median_px = reconstruction.median_px;
  report.ray_distance_mm = reconstruction.ray_distance_mm;
  if (reconstruction.turn_gap) {
    report.closure_px = reconstruction.turn_gap->px;
    report.closure_mm = reconstruction.turn_gap->mm;
  }
  report.sigma_mm = sigmaPercentiles(reconstruction.cloud);
  report.seconds.insert(reconstruction.seconds.begin(), reconstruction.seconds.end());
  report.drift = reconstruction.drift;
  report.turning = reconstruction.turning;
  report.versions["OpenCV"] = CV_VERSION;
  return report;
}

// As the table truly turned, where that was seen; a line for each view, in the views' order.
AngleList solvedAngles(const AngleTable& told, const std::optional<TurningReport>& turning) {
  AngleList angles;
  if (turning) {
    for (const TurnedView& each : turning->views) {
      if (told.contains(each.name)) angles.push_back({each.name, each.angle_rad});
    }
  }
  if (angles.size() == told.size()) return angles;
  angles.clear();
  for (const auto& [picture, angle_rad] : told) angles.push_back({picture, angle_rad});
  return angles;
}

Result<void> writePoints(const fs::path& folder, const Reconstruction& reconstruction,
                         const ResultContext& context) {
  const PointCloud& cloud = reconstruction.cloud;
  if (const auto done = writePly(folder / "points.ply", cloud); !done) return done;
  if (const auto done = writeVisibility(folder / "visibility.bin", cloud); !done) return done;
  if (const auto done = writeSightings(folder / "sightings.bin", reconstruction.sightings); !done) {
    return done;
  }
  if (const auto done = writeSilhouettes(folder / "silhouettes.bin", reconstruction.silhouettes);
      !done) {
    return done;
  }
  const auto done = writeCalibrationRecord(folder / "calibration.json", context.calibration);
  if (!done) return done;
  return writeAngleList(folder / "angles_solved.csv",
                        solvedAngles(context.angles, reconstruction.turning));
}

std::optional<SightEvidence> sightsOf(const Reconstruction& reconstruction,
                                      const ResultContext& context) {
  const Calibration& calibration = context.calibration.calibration;
  if (!calibration.cam_from_table) return std::nullopt;
  ResultViews views;
  for (const auto& [picture, angle_rad] : solvedAngles(context.angles, reconstruction.turning)) {
    const Rigid3 pose = camFromTable(*calibration.cam_from_table, angle_rad);
    views.push_back({picture, {calibration.camera, pose}, 0});
  }
  return sightsOf(views, reconstruction.silhouettes, reconstruction.cloud);
}

// A surface of the points; of the outlines, where points are too few to be trusted with it.
Result<MadeMesh> bestSurface(const PointCloud& cloud, const std::optional<SightEvidence>& sights,
                             const Task& task) {
  const bool enough = cloud.points.size() >= kEnoughPoints;
  if (!enough && sights && !sights->outlines.empty()) {
    MeshRequest request;
    request.method = MeshMethod::kSilhouette;
    auto hull = makeMesh(cloud, sights, request, task);
    if (hull || hull.error().code == Error::Code::kCancelled) return hull;
  }
  return makeMesh(cloud, sights, {}, task);
}

// So that it can be proved, years later, which files a model was made from.
Result<void> addFingerprints(const fs::path& folder, const ResultContext& context, Report& report,
                             const Task& task) {
  const auto add = [&](const char* name, const Result<std::string>& sum) {
    report.inputs[name] = sum ? *sum : "unknown: " + sum.error().what;
  };
  add("SHA-256 of calibration.json", fingerprintOf(folder / "calibration.json"));
  if (context.pictures.empty()) return {};
  const double start_s = steadySeconds();
  add("SHA-256 of the pictures' list", fingerprintOf(context.pictures, task));
  report.seconds["fingerprint"] = steadySeconds() - start_s;
  if (task.stopRequested()) return cancelled();
  return {};
}

Result<void> writeMesh(const fs::path& folder, const Mesh& mesh) {
  if (const auto done = writePly(folder / "mesh.ply", mesh); !done) return done;
  return writeObj(folder / "mesh.obj", mesh);
}

}  // namespace

Result<WrittenResults> writeResults(const fs::path& folder, const Reconstruction& reconstruction,
                                    const ResultContext& context, const Task& task) {
  if (const auto made = makeResultFolder(folder); !made) return made.error();
  if (const auto done = writePoints(folder, reconstruction, context); !done) {
    return done.error();
  }
  WrittenResults written;
  Report report = completed(context.report, reconstruction);
  const double start_s = steadySeconds();
  task.report(0.0, "Making the mesh");
  auto surface =
      bestSurface(reconstruction.cloud, sightsOf(reconstruction, context), task.part(0.0, 0.9));
  report.seconds["mesh"] = steadySeconds() - start_s;
  if (surface) {
    written.mesh = std::move(surface->mesh);
    written.method = surface->method;
    report.options["surface"] = wordOf(surface->method);
    if (surface->alpha_mm > 0.0) {
      report.options["alpha_mm"] = formatted("%.4g", surface->alpha_mm);
    }
    if (const auto done = writeMesh(folder, written.mesh); !done) return done.error();
  } else if (surface.error().code == Error::Code::kCancelled) {
    return surface.error();
  } else {
    written.mesh_problem = surface.error();
  }
  if (const auto done = addFingerprints(folder, context, report, task); !done) return done.error();
  if (const auto done = writeReport(folder, report); !done) return done.error();
  if (const auto done = writeReportPage(folder); !done) return done.error();
  return written;
}

Result<void> enoughPoints(const PointCloud& cloud, std::size_t views) {
  if (cloud.points.size() >= kEnoughPoints) return {};
  const std::string count = std::to_string(cloud.points.size());
  if (views < kFewViews) {
    return Error{
        Error::Code::kTooFew,
        "Only " + count + " points could be measured from " + std::to_string(views) + " views.",
        "Take more views of the turn: 72 for a quick scan, 200 for a full one."};
  }
  return Error{
      Error::Code::kTooFew,
      "The object has too little texture: only " + count + " points of it could be measured.",
      "Try raking light that brings out fine relief, and a sharper picture; a plain shape "
      "can also be made from its silhouettes. Put speckle or spray only on an object that "
      "may be altered."};
}

AngleTable anglesOfViews(const std::vector<CapturedView>& views) {
  AngleTable angles;
  for (const CapturedView& view : views) {
    angles[std::filesystem::path(view.file).filename().string()] = view.table_angle_rad;
  }
  return angles;
}

}  // namespace gyre
