// Where a scan stands and what may happen next: the one place that decides.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <QElapsedTimer>
#include <QObject>

#include "app/device_session.h"
#include "app/job_runner.h"
#include "app/latest.h"
#include "app/scan_session.h"
#include "app/surface_editor.h"
#include "app/surface_job.h"
#include "core/scan/calibration_record.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"
#include "core/scan/mesh_method.h"
#include "core/scan/point_cloud.h"
#include "core/scan/quick_look.h"
#include "core/scan/scan_pass.h"
#include "core/scan/tracked_frame.h"
#include "ui/facts.h"

namespace gyre {

using TrackedFramePtr = std::shared_ptr<const TrackedFrame>;

struct ScanRequest {
  int views = 72;
  std::filesystem::path folder;  // new or empty
  QString title;
};

// Belongs to the window's thread and never waits in it. Work is done by the device session's thread
// and one compute thread; what they find arrives here in queued calls, the newest winning.
class ScanController final : public QObject {
  Q_OBJECT

 public:
  explicit ScanController(RigOptions options, QObject* parent = nullptr);
  ~ScanController() override;

  DeviceSession& devices() { return devices_; }
  ScanPhase phase() const { return phase_; }
  const std::optional<CalibrationRecord>& calibration() const { return calibration_; }
  bool hasEmptyTable() const { return empty_table_.has_value(); }
  const PointCloudPtr& cloud() const { return cloud_; }
  // The surface as it stands after all steps that were applied and not undone; null without one.
  MeshPtr mesh() const { return editor_.now() != nullptr ? editor_.now()->mesh : nullptr; }
  SurfaceEditor& editor() { return editor_; }
  const std::filesystem::path& folder() const { return folder_; }

 public Q_SLOTS:
  bool useCalibration(const std::filesystem::path& file);  // false: told why not
  void takeEmptyTable();
  // One turn with a few pictures, and what they say of the object. stop() ends it, and the table.
  void quickLook();
  void startScan(const gyre::ScanRequest& request);
  void resumeScan();  // captures what the last scan, or an opened one, does not hold yet
  // The same after objected(): somebody says that nothing was moved. Pictures decide nothing then.
  void resumeTrusting();
  void pause();
  void resume();
  void stop();
  // 0: chosen by the program. One step of the editor's history; while a gap size is being dragged
  // all its surfaces together are one.
  void makeMesh(gyre::MeshMethod method, double gap_size_mm);
  void exportPoints(const std::filesystem::path& file);
  void exportMesh(const std::filesystem::path& file);  // as its ending says: writeModel()
  void openModel(const std::filesystem::path& scan_or_file);
  // A simulated object is turned over, as a person would do it; elsewhere nothing happens.
  void turnOver();
  // Makes one model of several results, each a folder, and shows it: mergeResults(). What was shown
  // stays when that fails, or is stopped.
  void merge(const std::vector<std::filesystem::path>& results);
  // Stops the table and everything else; quiet() follows when nothing runs any more.
  void shutDown();

 Q_SIGNALS:
  void phaseChanged(gyre::ScanPhase phase);
  void calibrationKnown(const gyre::CalibrationRecord& record, const QString& source);
  void emptyTableTaken();
  void lookedAt(const gyre::FramePtr& frame);           // during a quick look
  void quickLookTaken(const gyre::QuickLookPtr& look);  // null: what was told holds no longer
  void tracked(const gyre::TrackedFramePtr& frame);
  void cloudGrew(const gyre::PointCloudPtr& cloud);
  void factsChanged(const gyre::ScanFacts& facts);
  void meshMade(const gyre::MeshPtr& mesh, const gyre::MeshHealth& health);
  void modelChanged();  // cloud(), mesh() and folder() are those of another scan or file
  void passesKnown(const std::vector<gyre::ScanPass>& passes);  // of the model; empty: not merged
  void mergeRefused(const gyre::Error& error);
  void written(const QString& path);
  void progressed(double fraction, const QString& stage);
  void failed(const gyre::Error& error);
  // Instead of failed(): a scan was not taken up, for the pictures show that not all stands as it
  // stood. Nothing was captured, and nothing is lost.
  void objected(const gyre::Error& objection);
  void noticed(const QString& what, const QString& more);
  void logged(const QString& line);
  void quiet();
  void rested();  // no job goes on any more

 private:
  struct Live;     // what the threads of a running scan share
  struct Outcome;  // what a finished job leaves

  void setPhase(ScanPhase phase);
  void know(CalibrationRecord record, const std::filesystem::path& reference,
            const QString& source);
  void devicesOpened(const TurntableInfo& turntable);
  void devicesClosed();
  bool refuse(const QString& what, const QString& advice);
  bool readyToScan();
  void resumeWith(TakeUp take_up);
  ScanPlan planFor(ScanBegin begin, const ScanRequest& request) const;
  ScanObserver observerOf(const std::shared_ptr<Live>& live);
  void run(const ScanPlan& plan);
  void deliver();
  void finished(const Result<void>& outcome, const std::shared_ptr<Outcome>& result);
  void showMesh(const std::shared_ptr<Outcome>& result);
  void takeSurface(const SurfaceWish& wish, const MadeSurface& made);
  void makeNextSurface();
  void stopSurface();
  void takeOpened(const OpenedModel& opened);
  void beginComputing(ScanPhase phase);
  void endComputing(const Result<void>& outcome);
  void compute(JobRunner::Job job, JobRunner::Done done);
  void exportBy(std::function<Result<void>()> write, const std::filesystem::path& file);
  void noteIdle();

  ScanPhase phase_ = ScanPhase::kIdle;
  std::optional<CalibrationRecord> calibration_;
  std::filesystem::path reference_;  // belongs to the calibration; may be missing
  std::optional<EmptyTable> empty_table_;
  PointCloudPtr cloud_;
  std::shared_ptr<const AlphaShape> alpha_shape_;  // of cloud_, once it was asked for
  std::optional<SurfaceWish> next_surface_;        // the last, kept while another is being made
  bool making_surface_ = false;
  int surface_number_ = 0;  // of the newest that is wanted
  int jobs_ = 0;            // of the compute thread that have not ended
  int computing_ = 0;       // those of them that set the phase
  ScanPhase phase_before_computing_ = ScanPhase::kIdle;
  MeshPtr last_made_;  // by makeMesh(), and when it was asked for the last time
  QElapsedTimer since_wish_;
  std::filesystem::path folder_;
  std::weak_ptr<Rig> stopped_rig_;  // on it the user stopped the last scan: it knows its angle
  ScanFacts facts_;
  QElapsedTimer clock_;
  qint64 paused_ms_ = 0;
  qint64 paused_at_ms_ = 0;
  std::shared_ptr<Live> live_;
  bool shutting_down_ = false;
  DeviceSession devices_;
  JobRunner compute_jobs_;
  SurfaceEditor editor_;
};

}  // namespace gyre
