// What the scan controller does with points and surfaces: make, open, export.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "app/scan_controller.h"
#include "app/scan_outcome.h"
#include "core/io/model_writer.h"
#include "core/io/ply.h"

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

void ScanController::makeMesh(MeshMethod method, double gap_size_mm) {
  if (isCapturing(phase_)) return;
  const SurfaceWish wish{method, gap_size_mm};
  if (compute_jobs_.busy()) {
    if (phase_ == ScanPhase::kMeshing) next_surface_ = wish;
    return;
  }
  if (!cloud_ || cloud_->points.empty()) {
    refuse(tr("There are no points yet."), tr("Scan an object, or open a scan."));
    return;
  }
  auto made = std::make_shared<MadeSurface>();
  compute(
      [cloud = cloud_, folder = folder_, wish, shape = alpha_shape_,
       made](const Task& task) -> Result<void> {
        auto surface = makeSurface(*cloud, folder, wish, shape, task);
        if (!surface) return surface.error();
        *made = std::move(*surface);
        return {};
      },
      [this, cloud = cloud_, made](const Result<void>&) {
        if (cloud_ != cloud) return;
        alpha_shape_ = made->alpha_shape;
        mesh_ = made->mesh;
        Q_EMIT meshMade(mesh_, made->health);
        if (const auto next = std::exchange(next_surface_, std::nullopt)) {
          makeMesh(next->method, next->gap_size_mm);
        }
      });
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
        alpha_shape_.reset();
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
