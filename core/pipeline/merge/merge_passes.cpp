// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/merge_passes.h"

#include <string>
#include <system_error>
#include <utility>

#include "core/base/clock.h"
#include "core/base/formatted.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/obj.h"
#include "core/io/passes_file.h"
#include "core/io/ply.h"
#include "core/io/result_folder.h"
#include "core/io/silhouettes_file.h"
#include "core/io/visibility_file.h"
#include "core/pipeline/colour_mesh.h"
#include "core/pipeline/make_mesh.h"
#include "core/pipeline/merge/pass_input.h"
#include "core/pipeline/merge/place_passes.h"
#include "core/pipeline/report_page.h"
#include "core/pipeline/sights.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

// What all passes saw, in the merged frame, views numbered through.
struct Together {
  PointCloud cloud;
  PointSightings sightings;  // empty when one of the passes does not keep them
  Silhouettes silhouettes;
};

Point moved(Point point, const Rigid3& merged_from_pass, std::uint32_t first_view) {
  const Eigen::Matrix3d& turn = merged_from_pass.rotation;
  point.position = merged_from_pass * point.position;
  point.normal = turn * point.normal;
  point.covariance = turn * point.covariance * turn.transpose();
  for (std::uint32_t& view : point.views) view += first_view;
  return point;
}

Together putTogether(std::vector<PassInput> inputs, const std::vector<ScanPass>& passes) {
  Together all;
  std::uint32_t first_view = 0;
  bool all_keep_sightings = true;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    PassInput& pass = inputs[i];
    for (Point& point : pass.cloud.points) {
      all.cloud.points.push_back(moved(std::move(point), passes[i].merged_from_pass, first_view));
    }
    all_keep_sightings = all_keep_sightings && !pass.sightings.empty();
    for (auto& sightings : pass.sightings) {
      for (Observation& seen : sightings) seen.view += static_cast<std::int32_t>(first_view);
      all.sightings.push_back(std::move(sightings));
    }
    for (Silhouette& silhouette : pass.silhouettes) {
      all.silhouettes.push_back({silhouette.view + first_view, silhouette.mask});
    }
    first_view += static_cast<std::uint32_t>(pass.views.size());
  }
  if (!all_keep_sightings) all.sightings.clear();
  return all;
}

// Copies what tells the cameras of a pass, so that the merged result stands by itself.
Result<void> copyCameras(const ScanPass& pass, const fs::path& to) {
  if (const auto made = makeResultFolder(to); !made) return made;
  const auto record = readCalibrationRecord(pass.folder / "calibration.json");
  if (!record) return record.error();
  if (auto done = writeCalibrationRecord(to / "calibration.json", *record); !done) return done;
  const auto angles = readAngleList(pass.folder / "angles_solved.csv");
  if (!angles) return angles.error();
  return writeAngleList(to / "angles_solved.csv", *angles);
}

Result<void> writeCameras(const fs::path& folder, const std::vector<ScanPass>& passes) {
  for (const ScanPass& pass : passes) {
    if (auto done = copyCameras(pass, folder / pass.name); !done) return done;
  }
  const auto record = readCalibrationRecord(passes.front().folder / "calibration.json");
  if (!record) return record.error();
  if (auto done = writeCalibrationRecord(folder / "calibration.json", *record); !done) return done;
  return writePasses(folder / kPassesFile, passes);
}

Result<void> writeTogether(const fs::path& folder, const Together& all) {
  if (auto done = writePly(folder / "points.ply", all.cloud); !done) return done;
  if (auto done = writeVisibility(folder / "visibility.bin", all.cloud); !done) return done;
  if (!all.sightings.empty()) {
    if (auto done = writeSightings(folder / "sightings.bin", all.sightings); !done) return done;
  }
  return writeSilhouettes(folder / "silhouettes.bin", all.silhouettes);
}

Report reportOf(Report report, const std::vector<PassInput>& inputs,
                const std::vector<ScanPass>& passes) {
  const Report& first = inputs.front().report;
  if (report.title.empty()) report.title = first.title;
  if (report.inventory_number.empty()) report.inventory_number = first.inventory_number;
  if (report.rights.empty()) report.rights = first.rights;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    report.observations += inputs[i].report.observations;
    std::string text = passes[i].folder.string();
    if (const auto& fit = passes[i].fit) {
      text += formatted(": %zu spots agree, %.0f %% overlaps, %.3f mm apart there (median)",
                        fit->spots, 100.0 * fit->overlap, fit->residual_mm);
    }
    report.inputs[passes[i].name] = text;
  }
  return report;
}

Result<void> enough(const MergeRequest& request) {
  if (request.passes.size() < 2) {
    return Error{Error::Code::kInvalidInput, "One pass alone is nothing to merge.",
                 "Name the folders of two or more scans of the same object."};
  }
  std::error_code ignored;
  for (std::size_t i = 0; i < request.passes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!fs::equivalent(request.passes[i], request.passes[k], ignored)) continue;
      return Error{Error::Code::kInvalidInput,
                   "\"" + request.passes[i].string() + "\" is named twice.",
                   "Name each pass once."};
    }
    fs::path folder = request.passes[i];
    if (folder.extension() == ".gyre") folder = fs::absolute(folder).parent_path();
    if (!fs::equivalent(folder, request.out, ignored)) continue;
    return Error{Error::Code::kInvalidInput,
                 "The merged model would be written over \"" + request.out.string() + "\".",
                 "Name another folder for it."};
  }
  return {};
}

// A surface of all, which is coloured from the pictures: their light differs from pass to pass.
Result<void> addMesh(MergedPasses& merged, const Together& all, const fs::path& folder,
                     const Task& task) {
  const auto sights = readSights(folder, all.cloud);
  if (!sights) return sights.error();
  auto made = makeMesh(all.cloud, *sights, {}, task.part(0.0, 0.8));
  if (!made && made.error().code == Error::Code::kCancelled) return made.error();
  if (!made) {
    merged.mesh_problem = made.error();
    return {};
  }
  merged.mesh = std::move(made->mesh);
  const auto coloured =
      colourFromPictures(merged.mesh, folder, PictureFinder(folder), task.part(0.8, 1.0));
  if (!coloured) return coloured.error();
  if (auto done = writePly(folder / "mesh.ply", merged.mesh); !done) return done;
  return writeObj(folder / "mesh.obj", merged.mesh);
}

}  // namespace

Result<MergedPasses> mergePasses(const MergeRequest& request, const Task& task) {
  if (const auto fine = enough(request); !fine) return fine.error();
  std::vector<PassInput> inputs;
  for (const fs::path& each : request.passes) {
    auto input = readPass(each);
    if (!input) return input.error();
    inputs.push_back(std::move(*input));
  }
  const double start_s = steadySeconds();
  auto passes = placePasses(inputs, task.part(0.0, 0.5));
  if (!passes) return passes.error();
  const double placed_s = steadySeconds();
  Report report = reportOf(request.report, inputs, *passes);
  Together all = putTogether(std::move(inputs), *passes);
  if (const auto made = makeResultFolder(request.out); !made) return made.error();
  if (const auto done = writeCameras(request.out, *passes); !done) return done.error();
  if (const auto done = writeTogether(request.out, all); !done) return done.error();
  MergedPasses merged;
  if (const auto done = addMesh(merged, all, request.out, task.part(0.5, 1.0)); !done) {
    return done.error();
  }
  report.points = all.cloud.points.size();
  report.sigma_mm = sigmaPercentiles(all.cloud);
  report.seconds["passes"] = placed_s - start_s;
  report.seconds["mesh"] = steadySeconds() - placed_s;
  if (const auto done = writeReport(request.out, report); !done) return done.error();
  if (const auto done = writeReportPage(request.out); !done) return done.error();
  merged.passes = std::move(*passes);
  merged.cloud = std::move(all.cloud);
  return merged;
}

}  // namespace gyre
