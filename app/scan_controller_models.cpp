// What the scan controller does with points and surfaces: make, open, export.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "app/scan_controller.h"
#include "app/scan_outcome.h"
#include "core/io/model_writer.h"
#include "core/io/ply.h"
#include "core/mesh/alpha_shape.h"
#include "core/mesh/mesh_health.h"

namespace gyre {

void ScanController::showMesh(const std::shared_ptr<Outcome>& result) {
  if (result->problem) Q_EMIT failed(*result->problem);
  if (!result->mesh) return;
  mesh_ = result->mesh;
  Q_EMIT meshMade(mesh_, result->health);
}

void ScanController::compute(JobRunner::Job job, JobRunner::Done done) {
  const ScanPhase before = phase_;
  setPhase(ScanPhase::kMeshing);
  compute_jobs_.start(std::move(job),
                      [this, before, done = std::move(done)](const Result<void>& outcome) {
                        setPhase(before);
                        if (!outcome && outcome.error().code != Error::Code::kCancelled) {
                          Q_EMIT failed(outcome.error());
                        }
                        if (outcome) done(outcome);
                      });
}

void ScanController::makeMesh(double gap_size_mm) {
  if (isCapturing(phase_) || compute_jobs_.busy()) return;
  if (!cloud_ || cloud_->points.empty()) {
    refuse(tr("There are no points yet."), tr("Scan an object, or open a scan."));
    return;
  }
  auto result = std::make_shared<Outcome>();
  compute(
      [cloud = cloud_, gap_size_mm, result](const Task& task) -> Result<void> {
        AlphaShapeOptions options;
        options.alpha_mm = gap_size_mm;
        auto made = alphaShapeMesh(*cloud, options, task);
        if (!made) return made.error();
        result->health = meshHealth(made->mesh);
        result->mesh = std::make_shared<const Mesh>(std::move(made->mesh));
        return {};
      },
      [this, result](const Result<void>&) { showMesh(result); });
}

void ScanController::exportBy(std::function<Result<void>()> write,
                              const std::filesystem::path& file) {
  if (compute_jobs_.busy()) return;
  compute_jobs_.start([write = std::move(write)](const Task&) { return write(); },
                      [this, file](const Result<void>& outcome) {
                        if (outcome) {
                          Q_EMIT written(QString::fromStdString(file.string()));
                        } else {
                          Q_EMIT failed(outcome.error());
                        }
                      });
}

void ScanController::exportPoints(const std::filesystem::path& file) {
  if (!cloud_) return;
  exportBy([cloud = cloud_, file] { return writePly(file, *cloud); }, file);
}

void ScanController::exportMesh(const std::filesystem::path& file) {
  if (!mesh_) return;
  exportBy(
      [mesh = mesh_, scan = folder_, file] {
        return writeModel(file, *mesh, scan.empty() ? ModelLabel{} : labelOfScan(scan));
      },
      file);
}

void ScanController::openModel(const std::filesystem::path& scan_or_file) {
  if (isCapturing(phase_) || compute_jobs_.busy()) return;
  auto opened = std::make_shared<OpenedModel>();
  compute(
      [scan_or_file, opened](const Task& task) -> Result<void> {
        auto read = openScanOrModel(scan_or_file, task);
        if (!read) return read.error();
        *opened = std::move(read).value();
        return {};
      },
      [this, opened](const Result<void>&) {
        folder_ = opened->scan_folder;
        cloud_ = opened->cloud;
        mesh_ = opened->mesh;
        if (opened->calibration) {
          know(*opened->calibration, {}, tr("From the opened scan."));
        }
        facts_ = {};
        facts_.views = opened->views;
        facts_.views_done = opened->views_done;
        facts_.points = cloud_ ? cloud_->points.size() : 0;
        if (cloud_) facts_.median_sigma_mm = medianSigmaMm(*cloud_);
        Q_EMIT factsChanged(facts_);
        Q_EMIT cloudGrew(cloud_);
        if (mesh_) Q_EMIT meshMade(mesh_, opened->health);
        if (opened->views_done < opened->views) {
          Q_EMIT noticed(tr("This scan was interrupted after %1 of %2 views.")
                             .arg(opened->views_done)
                             .arg(opened->views),
                         tr("Connect the same turntable and camera; step 4 can go on with it."));
        }
      });
}

}  // namespace gyre
