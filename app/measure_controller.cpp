// Turns clicks on the model into lengths, and keeps them beside the scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/measure_controller.h"

#include <algorithm>
#include <utility>

#include <QDateTime>

#include "core/io/measurements_file.h"
#include "core/pipeline/report_page.h"

namespace gyre {
namespace {

constexpr const char* kFile = "measurements.json";

bool isSeen(const Mesh& mesh, std::size_t triangle) {
  const Triangle& corners = mesh.triangles[triangle];
  return std::all_of(corners.begin(), corners.end(),
                     [&](std::uint32_t corner) { return mesh.vertices[corner].seen != 0; });
}

PickedPoint pickedPoint(const Eigen::Vector3d& position, bool seen,
                        const PointPrecision& precision) {
  PickedPoint point;
  point.position = position;
  point.seen = seen;
  if (seen) point.covariance = precision.covarianceAt(position);
  return point;
}

}  // namespace

MeasureController::MeasureController(QObject* parent) : QObject(parent), jobs_("gyre-measure") {
  connect(&jobs_, &JobRunner::idle, this, &MeasureController::idle);
}

bool MeasureController::has(int index) const {
  return index >= 0 && static_cast<std::size_t>(index) < measurements_.size();
}

void MeasureController::setModel(const MeasuredModel& model) {
  model_ = model;
  measurements_.clear();
  begun_.reset();
  chosen_ = -1;
  precision_.reset();
  may_keep_ = false;
  tell();
  if (model.folder.empty()) return;
  auto read = std::make_shared<std::vector<Measurement>>();
  jobs_.start(
      [file = model.folder / kFile, read](const Task&) -> Result<void> {
        auto measurements = readMeasurements(file);
        if (!measurements) return measurements.error();
        *read = std::move(*measurements);
        return {};
      },
      [this, folder = model.folder, read](const Result<void>& outcome) {
        if (model_.folder != folder) return;
        may_keep_ = outcome.ok() || outcome.error().code == Error::Code::kNotFound;
        if (!may_keep_) Q_EMIT failed(outcome.error());
        const bool measured_meanwhile = !measurements_.empty();
        measurements_.insert(measurements_.begin(), read->begin(), read->end());
        if (chosen_ >= 0) chosen_ += static_cast<int>(read->size());
        tell();
        if (measured_meanwhile) keep();
      });
}

void MeasureController::pick(const ScenePick& pick, const MeshPtr& mesh) {
  Place place;
  place.position = pick.position;
  place.mesh = mesh;
  if (pick.on == ScenePick::On::kTriangle) {
    if (!mesh || pick.index >= mesh->triangles.size()) return;
    place.seen = isSeen(*mesh, pick.index);
  }
  if (!begun_) {
    begun_ = place;
    chosen_ = -1;
    tell();
    return;
  }
  const Place from = *std::exchange(begun_, std::nullopt);
  measure(from, place);
}

void MeasureController::measure(const Place& from, const Place& to) {
  auto measured = std::make_shared<Measurement>();
  auto precision = std::make_shared<std::shared_ptr<const PointPrecision>>(precision_);
  jobs_.start(
      [from, to, model = model_, measured, precision](const Task&) -> Result<void> {
        if (!*precision) {
          *precision = model.cloud || !to.mesh ? std::make_shared<const PointPrecision>(
                                                     model.cloud ? *model.cloud : PointCloud())
                                               : std::make_shared<const PointPrecision>(*to.mesh);
        }
        auto length = measureLength(pickedPoint(from.position, from.seen, **precision),
                                    pickedPoint(to.position, to.seen, **precision), model.scale);
        if (!length) return length.error();
        *measured = std::move(*length);
        return {};
      },
      [this, cloud = model_.cloud, folder = model_.folder, measured,
       precision](const Result<void>& outcome) {
        if (cloud != model_.cloud || folder != model_.folder) return;  // another was opened
        if (!outcome) {
          tell();
          Q_EMIT failed(outcome.error());
          return;
        }
        if (cloud) precision_ = *precision;  // a mesh may be another the next time
        measured->date = QDateTime::currentDateTime().toString(Qt::ISODate).toStdString();
        measurements_.push_back(*measured);
        if (!begun_) chosen_ = static_cast<int>(measurements_.size()) - 1;
        tell();
        keep();
      });
}

void MeasureController::forgetBegun() {
  if (!begun_) return;
  begun_.reset();
  tell();
}

void MeasureController::choose(int index) {
  if (index == chosen_ || (index >= 0 && !has(index))) return;
  chosen_ = index;
  tell();
}

void MeasureController::setCaliperMm(int index, double caliper_mm) {
  if (!has(index)) return;
  auto& caliper = measurements_[static_cast<std::size_t>(index)].caliper_mm;
  caliper = caliper_mm > 0.0 ? std::optional(caliper_mm) : std::nullopt;
  tell();
  keep();
}

void MeasureController::remove(int index) {
  if (!has(index)) return;
  measurements_.erase(measurements_.begin() + index);
  chosen_ = -1;
  tell();
  keep();
}

void MeasureController::tell() {
  std::vector<SceneLine> lines;
  if (begun_) lines.push_back({begun_->position, begun_->position, {}});
  if (has(chosen_)) {
    const Measurement& chosen = measurements_[static_cast<std::size_t>(chosen_)];
    lines.push_back(
        {chosen.from_in_table, chosen.to_in_table, QString::fromStdString(lengthText(chosen))});
  }
  Q_EMIT linesChanged(lines);
  Q_EMIT changed(measurements_, chosen_);
}

void MeasureController::keep() {
  if (model_.folder.empty() || !may_keep_) return;
  jobs_.start(
      [folder = model_.folder, measurements = measurements_](const Task&) -> Result<void> {
        if (auto kept = writeMeasurements(folder / kFile, measurements); !kept) return kept;
        return refreshReportPage(folder);
      },
      [this](const Result<void>& outcome) {
        if (!outcome) Q_EMIT failed(outcome.error());
      });
}

}  // namespace gyre
