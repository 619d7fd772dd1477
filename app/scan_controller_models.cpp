// What the scan controller does with points and surfaces: make, open, export.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "app/scan_controller.h"
#include "app/scan_outcome.h"
#include "core/io/model_writer.h"
#include "core/io/ply.h"
#include "ui/surface_kinds.h"

namespace gyre {
namespace {

// As the history names it.
QString surfaceStepText(const SurfaceWish& wish) {
  if (wish.method == MeshMethod::kAlpha && wish.gap_size_mm > 0.0) {
    return ScanController::tr("gap size %1 mm").arg(wish.gap_size_mm, 0, 'f', 2);
  }
  return ScanController::tr("surface: %1").arg(surfaceKind(wish.method).name.toLower());
}

}  // namespace

void ScanController::showMesh(const std::shared_ptr<Outcome>& result) {
  if (result->problem) Q_EMIT failed(*result->problem);
  if (!result->mesh) return;
  editor_.begin({result->mesh, result->health, {}, tr("scan").toStdString()});
  Q_EMIT meshMade(result->mesh, result->health);
}

void ScanController::beginComputing(ScanPhase phase) {
  ++jobs_;
  if (computing_++ == 0) phase_before_computing_ = phase_;
  setPhase(phase);
}

void ScanController::endComputing(const Result<void>& outcome) {
  --jobs_;
  if (--computing_ == 0) setPhase(phase_before_computing_);
  if (!outcome && outcome.error().code != Error::Code::kCancelled) {
    Q_EMIT failed(outcome.error());
  }
}

void ScanController::compute(JobRunner::Job job, JobRunner::Done done) {
  beginComputing(ScanPhase::kMeshing);
  compute_jobs_.start(std::move(job), [this, done = std::move(done)](const Result<void>& outcome) {
    endComputing(outcome);
    if (outcome) done(outcome);
    makeNextSurface();
  });
}

void ScanController::makeMesh(MeshMethod method, double gap_size_mm) {
  if (isCapturing(phase_)) return;
  const SurfaceWish wish{method, gap_size_mm};
  if (jobs_ > 0) {
    next_surface_ = wish;
    return;
  }
  if (!cloud_ || cloud_->points.empty()) {
    refuse(tr("There are no points yet."), tr("Scan an object, or open a scan."));
    return;
  }
  making_surface_ = true;
  editor_.dropPreview();
  editor_.noteMaking(tr("the surface that is being built"));
  auto made = std::make_shared<MadeSurface>();
  compute(
      [cloud = cloud_, folder = folder_, wish, shape = alpha_shape_,
       made](const Task& task) -> Result<void> {
        auto surface = makeSurface(*cloud, folder, wish, shape, task);
        if (!surface) return surface.error();
        *made = std::move(*surface);
        return {};
      },
      [this, cloud = cloud_, wish, made, number = ++surface_number_](const Result<void>&) {
        if (cloud_ == cloud && number == surface_number_) takeSurface(wish, *made);
      });
}

// Surfaces that follow each other as a slider moves are one step.
void ScanController::takeSurface(const SurfaceWish& wish, const MadeSurface& made) {
  constexpr qint64 kDragPause_ms = 1500;
  const SurfaceState* now = editor_.now();
  const bool dragged = now != nullptr && now->mesh == last_made_ &&
                       wish.method == MeshMethod::kAlpha && now->wish.method == wish.method &&
                       since_wish_.isValid() && since_wish_.elapsed() < kDragPause_ms;
  since_wish_.start();
  alpha_shape_ = made.alpha_shape;
  last_made_ = made.mesh;
  SurfaceState state{made.mesh, made.health, wish, surfaceStepText(wish).toStdString()};
  if (dragged) {
    editor_.replace(std::move(state));
  } else {
    editor_.add(std::move(state));
  }
  if (!made.remark.empty()) Q_EMIT noticed(QString::fromStdString(made.remark), QString());
  Q_EMIT meshMade(made.mesh, made.health);
}

// Called after every job: a surface that was asked for meanwhile is made.
void ScanController::makeNextSurface() {
  if (jobs_ > 0) return;
  making_surface_ = false;
  editor_.noteMaking({});
  if (const auto next = std::exchange(next_surface_, std::nullopt)) {
    makeMesh(next->method, next->gap_size_mm);
  }
}

void ScanController::stopSurface() {
  if (!making_surface_) return;
  ++surface_number_;  // it may have been finished at this very moment
  next_surface_.reset();
  compute_jobs_.requestStop();
}

void ScanController::exportBy(std::function<Result<void>()> write,
                              const std::filesystem::path& file) {
  ++jobs_;
  compute_jobs_.start(
      [write = std::move(write)](const Task&) { return write(); },
      [this, file](const Result<void>& outcome) {
        --jobs_;
        if (outcome) {
          Q_EMIT written(QString::fromStdString(file.string()));
        } else if (outcome.error().code == Error::Code::kCancelled) {
          Q_EMIT noticed(
              tr("Stopped before %1 was written.").arg(QString::fromStdString(file.string())),
              tr("Export it again."));
        } else {
          Q_EMIT failed(outcome.error());
        }
        makeNextSurface();
      });
}

void ScanController::exportPoints(const std::filesystem::path& file) {
  if (!cloud_) return;
  exportBy([cloud = cloud_, file] { return writePly(file, *cloud); }, file);
}

void ScanController::exportMesh(const std::filesystem::path& file) {
  if (!mesh()) return;
  exportBy(
      [mesh = mesh(), scan = folder_, file] {
        return writeModel(file, *mesh, scan.empty() ? ModelLabel{} : labelOfScan(scan));
      },
      file);
}

void ScanController::openModel(const std::filesystem::path& scan_or_file) {
  if (isCapturing(phase_) || phase_ == ScanPhase::kFinishing) {
    refuse(tr("A scan is going on."), tr("Stop it, or wait for its end, and open the other then."));
    return;
  }
  stopSurface();
  auto opened = std::make_shared<OpenedModel>();
  compute(
      [scan_or_file, opened](const Task& task) -> Result<void> {
        auto read = openScanOrModel(scan_or_file, task);
        if (!read) return read.error();
        *opened = std::move(read).value();
        return {};
      },
      [this, opened](const Result<void>&) { takeOpened(*opened); });
}

void ScanController::takeOpened(const OpenedModel& opened) {
  folder_ = opened.scan_folder;
  cloud_ = opened.cloud;
  alpha_shape_.reset();
  next_surface_.reset();
  if (opened.mesh) {
    editor_.begin({opened.mesh, opened.health, {}, tr("opened").toStdString()});
  } else {
    editor_.clear();
  }
  if (opened.calibration) {
    know(*opened.calibration, {}, tr("From the opened scan."));
  }
  facts_ = {};
  facts_.views = opened.views;
  facts_.views_done = opened.views_done;
  facts_.points = cloud_ ? cloud_->points.size() : 0;
  if (cloud_) facts_.median_sigma_mm = medianSigmaMm(*cloud_);
  Q_EMIT factsChanged(facts_);
  Q_EMIT cloudGrew(cloud_);
  Q_EMIT modelChanged();
  Q_EMIT passesKnown(opened.passes);
  if (opened.mesh) Q_EMIT meshMade(opened.mesh, opened.health);
  if (opened.views_done < opened.views) {
    Q_EMIT noticed(tr("This scan was interrupted after %1 of %2 views.")
                       .arg(opened.views_done)
                       .arg(opened.views),
                   tr("Connect the same turntable and camera; step 5 can go on with it."));
  }
}

}  // namespace gyre
