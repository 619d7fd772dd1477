// Turns clicks on the model into lengths, and keeps them beside the scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <QObject>

#include "app/job_runner.h"
#include "core/base/result.h"
#include "core/mesh/point_precision.h"
#include "core/scan/measurement.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"
#include "ui/scene_pick.h"

namespace gyre {

// What is measured on.
struct MeasuredModel {
  PointCloudPtr cloud;  // tells how sure places are; null: the mesh does, if it knows
  ModelScale scale;
  std::filesystem::path folder;  // where measurements.json lies; empty: nothing is kept
};

// Belongs to the window's thread and never waits in it: searching among the points and writing are
// done in a thread of its own.
class MeasureController final : public QObject {
  Q_OBJECT

 public:
  explicit MeasureController(QObject* parent = nullptr);

  const std::vector<Measurement>& measurements() const { return measurements_; }
  bool busy() const { return jobs_.busy(); }

 public Q_SLOTS:
  // Reads what was measured on it before. A file that cannot be read is told of and never replaced.
  void setModel(const gyre::MeasuredModel& model);
  // The first click begins a length, the second ends it, the third begins another. mesh: on which
  // the pick stands, may be null.
  void pick(const gyre::ScenePick& pick, const gyre::MeshPtr& mesh);
  void forgetBegun();                               // the first click without a second
  void choose(int index);                           // whose line is drawn; -1: none
  void setCaliperMm(int index, double caliper_mm);  // 0: none
  void remove(int index);

 Q_SIGNALS:
  // After any change; chosen as in choose().
  void changed(const std::vector<gyre::Measurement>& measurements, int chosen);
  void linesChanged(const std::vector<gyre::SceneLine>& lines);
  void failed(const gyre::Error& error);
  void idle();

 private:
  struct Place {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    bool seen = true;
    MeshPtr mesh;
  };

  bool has(int index) const;
  void measure(const Place& from, const Place& to);
  void tell();
  void keep();

  MeasuredModel model_;
  std::vector<Measurement> measurements_;
  std::optional<Place> begun_;
  int chosen_ = -1;
  bool may_keep_ = false;                            // the file there was read, or there was none
  std::shared_ptr<const PointPrecision> precision_;  // of the model's cloud, once it was needed
  JobRunner jobs_;
};

}  // namespace gyre
