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
class DevicePanel;
class ExportPanel;
class JobBar;
class MeshPanel;
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
  StepList* steps;
  DevicePanel* device_panel;
  CalibrationPanel* calibration_panel;
  PlacePanel* place_panel;
  ScanPanel* scan_panel;
  MeshPanel* mesh_panel;
  ExportPanel* export_panel;
  CameraView* camera_view;
  SceneView* scene_view;
  JobBar* job_bar;

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showStep(gyre::Step step);

 private:
  QWidget* buildSteps();
  QWidget* buildViews();

  QStackedWidget* panels_;
};

}  // namespace gyre
