// What is done to a surface once it is made: clean-up with a preview, undo and redo.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <QObject>
#include <QString>
#include <QTimer>

#include "app/job_runner.h"
#include "app/surface_history.h"
#include "core/base/result.h"
#include "core/mesh/clean/clean_mesh.h"
#include "core/mesh/clean/options.h"
#include "core/scan/clean_report.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"
#include "ui/facts.h"

namespace gyre {

// Belongs to the window's thread and never waits in it. Cleaning runs in a thread of its own, so
// that an export or another surface never waits for a preview; the newest wish wins, and stops the
// one before it at once. Points and files are never touched.
class SurfaceEditor final : public QObject {
  Q_OBJECT

 public:
  explicit SurfaceEditor(QObject* parent = nullptr);

  // Null when there is no surface. Previews do not count: this is what is exported.
  const SurfaceState* now() const { return history_.now(); }
  // What the 3D view shall show: the preview where there is one, else now(), or what was before
  // either while that is asked for. Null when there is no surface.
  MeshPtr shown() const { return shownState() != nullptr ? shownState()->mesh : nullptr; }
  MeshHealth shownHealth() const;
  bool previewing() const { return preview_.has_value() || waits_; }
  bool busy() const { return jobs_.busy(); }

  // Each ends a preview.
  void begin(SurfaceState first);  // of another scan: nothing can be undone
  void add(SurfaceState made);
  void replace(SurfaceState made);
  void clear();
  void requestStop();  // of the running preview
  // While another surface is being made, undo() asks to stop that; empty: none is.
  void noteMaking(const QString& what);

 public Q_SLOTS:
  void preview(const gyre::CleanOptions& options);  // of now(); without a surface nothing happens
  void dropPreview();
  void apply();  // makes the preview the present state, as soon as it is there
  void undo();   // what is being made, else a preview, else the last step
  void redo();
  void setSide(gyre::EditSide side);

 Q_SIGNALS:
  void stateChanged();  // now() is another
  // Of now(), once its self-intersections have been counted, in a thread of their own.
  void healthKnown(const gyre::MeshHealth& health);
  void sceneChanged();  // shown() is another
  void factsChanged(const gyre::EditFacts& facts);
  void previewBegun();
  void previewProgressed(double fraction, const QString& stage);
  void previewMade(const gyre::CleanReport& report);
  void previewRefused(const gyre::Error& error);  // the preview is gone, its options stand
  void previewEnded();                            // dropped or applied: begin anew
  void stopRequested();                           // of what noteMaking() told
  void idle();

 private:
  struct Preview {
    SurfaceState state;
    CleanReport report;
  };

  const SurfaceState* shownState() const;
  void startPreview();
  void previewDone(const Result<void>& outcome, std::optional<Preview> made);
  void endPreview();
  void tellState();
  void countSelfIntersections();
  EditFacts facts() const;

  SurfaceHistory history_;
  std::optional<Preview> preview_;
  std::optional<CleanOptions> wish_;  // the newest, while an older one is still being stopped
  bool waits_ = false;                // a preview that is wanted is not there yet
  bool running_ = false;
  bool apply_when_made_ = false;
  std::uint64_t wish_number_ = 0;
  std::shared_ptr<RepeatedCleanUp> clean_up_;  // of now(); used in the thread of previews alone
  QString making_;
  EditSide side_ = EditSide::kAfter;
  JobRunner jobs_;
  QTimer count_pause_;  // while a slider is dragged every surface is soon another
  JobRunner counts_;
};

// "crop, smooth": the steps of a report that a person asked for.
std::string stepsText(const CleanReport& report);

}  // namespace gyre
