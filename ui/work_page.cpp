// The page on which a scan is made: steps, live picture, 3D view, progress.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/work_page.h"

#include <QHBoxLayout>
#include <QSplitter>
#include <QStackedWidget>

#include "ui/banner.h"
#include "ui/calibration_panel.h"
#include "ui/camera_view.h"
#include "ui/clean_panel.h"
#include "ui/device_panel.h"
#include "ui/export_panel.h"
#include "ui/focus_panel.h"
#include "ui/hand_card.h"
#include "ui/job_bar.h"
#include "ui/measure_panel.h"
#include "ui/mesh_panel.h"
#include "ui/model_tools.h"
#include "ui/panel_scroll.h"
#include "ui/parts.h"
#include "ui/place_panel.h"
#include "ui/scan_panel.h"
#include "ui/scene_view.h"
#include "ui/step_list.h"

namespace gyre {
namespace {

constexpr int kStepsWidth_px = 324;
constexpr int kEditingWidth_px = 316;

// A view in a card, under a line that names it.
QFrame* framed(const QString& title, const QString& legend, QWidget* view, QWidget* tool) {
  auto* frame = new QFrame;
  frame->setProperty("card", true);
  auto* layout = new QVBoxLayout(frame);
  layout->setContentsMargins(10, 8, 10, 10);
  auto* row = new QHBoxLayout;
  QLabel* name = makeLabel(title, "heading");
  name->setWordWrap(false);
  name->setMinimumHeight(30);
  row->addWidget(name);
  row->addStretch(1);
  QLabel* text = makeLabel(legend, "muted");
  text->setTextFormat(Qt::RichText);
  text->setWordWrap(false);
  row->addWidget(text);
  if (tool != nullptr) row->addWidget(tool);
  layout->addLayout(row);
  layout->addWidget(view, 1);
  return frame;
}

}  // namespace

WorkPage::WorkPage(QWidget* parent) : QWidget(parent) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 12, 12, 12);
  layout->setSpacing(kGap_px);
  layout->addWidget(buildSteps());
  auto* right = new QVBoxLayout;
  right->setSpacing(kGap_px);
  layout->addLayout(right, 1);
  banner = new Banner;
  right->addWidget(banner);
  hand_card = new HandCard;
  right->addWidget(hand_card);
  right->addWidget(buildViews(), 1);
  job_bar = new JobBar;
  right->addWidget(job_bar);
  showPhase(ScanPhase::kIdle);
}

QWidget* WorkPage::buildSteps() {
  auto* column = new QWidget;
  column->setFixedWidth(kStepsWidth_px);
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGap_px);
  steps = new StepList;
  layout->addWidget(steps);
  device_panel = new DevicePanel;
  focus_panel = new FocusPanel;
  calibration_panel = new CalibrationPanel;
  place_panel = new PlacePanel;
  scan_panel = new ScanPanel;
  mesh_panel = new MeshPanel;
  export_panel = new ExportPanel;
  panels_ = new QStackedWidget;
  for (QWidget* panel : {static_cast<QWidget*>(device_panel), static_cast<QWidget*>(focus_panel),
                         static_cast<QWidget*>(calibration_panel),
                         static_cast<QWidget*>(place_panel), static_cast<QWidget*>(scan_panel),
                         static_cast<QWidget*>(mesh_panel), static_cast<QWidget*>(export_panel)}) {
    panels_->addWidget(new PanelScroll(panel));
  }
  layout->addWidget(panels_, 1);
  connect(steps, &StepList::stepChosen, this, &WorkPage::showStep);
  return column;
}

QWidget* WorkPage::buildViews() {
  camera_view = new CameraView;
  scene_view = new SceneView;
  model_tools = new ModelTools;
  connect(model_tools, &ModelTools::fitRequested, scene_view, &SceneView::fit);
  auto* splitter = new QSplitter(Qt::Horizontal);
  splitter->setChildrenCollapsible(false);
  splitter->setHandleWidth(kGap_px);
  camera_frame_ = framed(tr("Camera"),
                         tr("<span style='color:#8b97a3'>●</span> seen once  "
                            "<span style='color:#e0a81e'>●</span> followed  "
                            "<span style='color:#2fb567'>●</span> measured"),
                         camera_view, nullptr);
  splitter->addWidget(camera_frame_);
  splitter->addWidget(framed(tr("Model"), QString(), scene_view, model_tools));
  splitter->setStretchFactor(0, 4);
  splitter->setStretchFactor(1, 5);
  splitter->setSizes({1000, 1250});
  auto* views = new QWidget;
  auto* row = new QHBoxLayout(views);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kGap_px);
  row->addWidget(splitter, 1);
  editing_ = buildEditing();
  row->addWidget(editing_);
  return views;
}

QWidget* WorkPage::buildEditing() {
  clean_panel = new CleanPanel;
  measure_panel = new MeasurePanel(model_tools->measure);
  auto* column = new QWidget;
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGap_px);
  layout->addWidget(clean_panel);
  layout->addWidget(measure_panel);
  layout->addStretch(1);
  auto* scroll = new PanelScroll(column);
  scroll->setFixedWidth(kEditingWidth_px);
  scroll->hide();
  return scroll;
}

void WorkPage::showPhase(ScanPhase phase) {
  device_panel->showPhase(phase);
  focus_panel->showPhase(phase);
  place_panel->showPhase(phase);
  scan_panel->showPhase(phase);
  mesh_panel->showPhase(phase);
  job_bar->showPhase(phase);
}

Step WorkPage::shownStep() const { return static_cast<Step>(panels_->currentIndex()); }

void WorkPage::showStep(Step step) {
  steps->setShown(step);
  panels_->setCurrentIndex(static_cast<int>(step));
  // Where the model is worked on it gets the camera's place.
  camera_frame_->setVisible(step != Step::kMesh && step != Step::kExport);
  editing_->setVisible(step == Step::kMesh);
  Q_EMIT stepShown(step);
}

}  // namespace gyre
