// The page on which a scan is made: steps, live picture, 3D view, progress.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/facts.h"

class QBoxLayout;
class QStackedWidget;

namespace gyre {

class Banner;
class CalibrationPanel;
class CameraView;
class CleanPanel;
class DevicePanel;
class ExportPanel;
class FocusPanel;
class HandCard;
class JobBar;
class MeasurePanel;
class MeshPanel;
class ModelTools;
class PlacePanel;
class ScanPanel;
class SceneView;
class StepList;

// Lays the parts out and tells all of them the phase. The parts are wired by whoever owns the page.
class WorkPage final : public QWidget {
  Q_OBJECT

 public:
  explicit WorkPage(QWidget* parent = nullptr);

  // Parts, all children of the page.
  Banner* banner;
  HandCard* hand_card;
  StepList* steps;
  DevicePanel* device_panel;
  FocusPanel* focus_panel;
  CalibrationPanel* calibration_panel;
  PlacePanel* place_panel;
  ScanPanel* scan_panel;
  MeshPanel* mesh_panel;
  CleanPanel* clean_panel;
  MeasurePanel* measure_panel;
  ExportPanel* export_panel;
  CameraView* camera_view;
  SceneView* scene_view;
  ModelTools* model_tools;  // over the scene
  JobBar* job_bar;

  Step shownStep() const;

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showStep(gyre::Step step);

 Q_SIGNALS:
  void stepShown(gyre::Step step);

 private:
  QWidget* buildSteps();
  QWidget* buildViews();
  QWidget* buildEditing();

  QStackedWidget* panels_;
  QWidget* camera_frame_;
  QWidget* editing_;  // beside the model, in the step that works on it
};

}  // namespace gyre
