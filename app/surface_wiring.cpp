// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/surface_wiring.h"

#include <QAction>
#include <QShortcut>

#include "app/measure_controller.h"
#include "app/scan_controller.h"
#include "ui/banner.h"
#include "ui/clean_panel.h"
#include "ui/export_panel.h"
#include "ui/health_words.h"
#include "ui/measure_panel.h"
#include "ui/mesh_panel.h"
#include "ui/model_tools.h"
#include "ui/scene_view.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

void wireMaking(WorkPage& page, ScanController& scans) {
  MeshPanel* mesh = page.mesh_panel;
  QObject::connect(mesh, &MeshPanel::meshRequested, &scans, &ScanController::makeMesh);
  QObject::connect(mesh, &MeshPanel::coloursChosen, page.scene_view, &SceneView::setColours);
  QObject::connect(mesh, &MeshPanel::pointsShown, page.scene_view,
                   [&page] { page.scene_view->showMesh(nullptr); });
  QObject::connect(mesh, &MeshPanel::surfaceShown, page.scene_view,
                   [&page, &scans] { page.scene_view->showMesh(scans.editor().shown()); });
  QObject::connect(&scans, &ScanController::cloudGrew, mesh, [mesh](const PointCloudPtr& cloud) {
    mesh->showPoints(cloud ? cloud->points.size() : 0);
  });
}

void wireCleaning(WorkPage& page, ScanController& scans) {
  SurfaceEditor* editor = &scans.editor();
  CleanPanel* clean = page.clean_panel;
  ModelTools* tools = page.model_tools;
  QObject::connect(clean, &CleanPanel::previewRequested, editor, &SurfaceEditor::preview);
  QObject::connect(clean, &CleanPanel::previewDropped, editor, &SurfaceEditor::dropPreview);
  QObject::connect(clean, &CleanPanel::applyRequested, editor, &SurfaceEditor::apply);
  QObject::connect(clean, &CleanPanel::cropChanged, page.scene_view, &SceneView::showCrop);
  QObject::connect(tools->undo, &QAction::triggered, editor, &SurfaceEditor::undo);
  QObject::connect(tools->redo, &QAction::triggered, editor, &SurfaceEditor::redo);
  QObject::connect(tools, &ModelTools::sideChosen, editor, &SurfaceEditor::setSide);
  QObject::connect(tools->hatching, &QAction::toggled, page.scene_view, [&page](bool on) {
    page.scene_view->setHatching(on ? Hatching::kShown : Hatching::kHidden);
  });
  QObject::connect(editor, &SurfaceEditor::previewBegun, clean, &CleanPanel::showBegun);
  QObject::connect(editor, &SurfaceEditor::previewBegun, page.mesh_panel,
                   &MeshPanel::lookAtSurface);
  QObject::connect(editor, &SurfaceEditor::previewProgressed, clean, &CleanPanel::showProgress);
  QObject::connect(editor, &SurfaceEditor::previewMade, clean, &CleanPanel::showReport);
  QObject::connect(editor, &SurfaceEditor::previewRefused, clean, &CleanPanel::showProblem);
  QObject::connect(editor, &SurfaceEditor::previewEnded, clean, &CleanPanel::reset);
  QObject::connect(editor, &SurfaceEditor::factsChanged, clean, &CleanPanel::showFacts);
  QObject::connect(editor, &SurfaceEditor::factsChanged, tools, &ModelTools::showFacts);
}

// The state that is exported, and the scene, which may show a preview or what was before.
void wireStates(WorkPage& page, ScanController& scans) {
  SurfaceEditor* editor = &scans.editor();
  QObject::connect(editor, &SurfaceEditor::healthKnown, page.mesh_panel, &MeshPanel::showHealth);
  QObject::connect(editor, &SurfaceEditor::stateChanged, &page, [&page, &scans, editor] {
    const SurfaceState* now = editor->now();
    const std::size_t triangles = now != nullptr ? now->mesh->triangles.size() : 0;
    page.export_panel->showAvailable(scans.cloud() ? scans.cloud()->points.size() : 0, triangles);
    page.model_tools->showSurface(triangles);
    page.clean_panel->showSurface(now != nullptr ? boundsOf(*now->mesh) : Bounds{}, triangles);
    if (now == nullptr) {
      page.mesh_panel->showNoMesh();
      return;
    }
    page.mesh_panel->showSurface(now->wish.method, now->wish.gap_size_mm);
    page.mesh_panel->showHealth(now->health);
  });
  QObject::connect(editor, &SurfaceEditor::sceneChanged, page.scene_view, [&page, editor] {
    page.scene_view->setUnseenShare(unseenShare(editor->shownHealth()));
    if (page.mesh_panel->showsSurface() || !editor->shown()) {
      page.scene_view->showMesh(editor->shown());
    }
  });
}

void wireMeasuring(WorkPage& page, ScanController& scans, MeasureController& measures) {
  MeasurePanel* panel = page.measure_panel;
  QAction* measure = page.model_tools->measure;
  QObject::connect(measure, &QAction::toggled, &measures, [&page, &measures](bool on) {
    page.scene_view->setPicking(on ? Picking::kOn : Picking::kOff);
    if (!on) measures.forgetBegun();
  });
  auto* end = new QShortcut(Qt::Key_Escape, &page);
  end->setEnabled(false);
  QObject::connect(measure, &QAction::toggled, end, &QShortcut::setEnabled);
  QObject::connect(end, &QShortcut::activated, measure, [measure] { measure->setChecked(false); });
  QObject::connect(page.scene_view, &SceneView::picked, &measures,
                   [&page, &scans, &measures](const ScenePick& pick) {
                     const bool on_surface = page.mesh_panel->showsSurface();
                     measures.pick(pick, on_surface ? scans.editor().shown() : nullptr);
                   });
  QObject::connect(panel, &MeasurePanel::chosen, &measures, &MeasureController::choose);
  QObject::connect(panel, &MeasurePanel::caliperEntered, &measures,
                   &MeasureController::setCaliperMm);
  QObject::connect(panel, &MeasurePanel::removeRequested, &measures, &MeasureController::remove);
  QObject::connect(&measures, &MeasureController::changed, panel, &MeasurePanel::showMeasurements);
  QObject::connect(&measures, &MeasureController::linesChanged, page.scene_view,
                   &SceneView::showLines);
  QObject::connect(&measures, &MeasureController::failed, page.banner, &Banner::showError);
  QObject::connect(&scans, &ScanController::modelChanged, &measures, [&scans, &measures, panel] {
    MeasuredModel model;
    model.cloud = scans.cloud();
    model.folder = scans.folder();
    // A file alone does not tell with which calibration it was made.
    if (!model.folder.empty() && scans.calibration()) model.scale = scaleOf(*scans.calibration());
    measures.setModel(model);
    panel->showKept(model.folder.empty()
                        ? MeasurePanel::tr("Lengths on a single file are kept until another is "
                                           "opened.")
                        : MeasurePanel::tr("Kept in measurements.json in the scan's folder."));
  });
}

}  // namespace

void wireSurface(WorkPage& page, ScanController& scans, MeasureController& measures) {
  wireMaking(page, scans);
  wireCleaning(page, scans);
  wireStates(page, scans);
  wireMeasuring(page, scans, measures);
}

}  // namespace gyre
