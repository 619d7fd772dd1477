// The window: start page or work page, menus, log. Behaviour is wired from outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/main_window.h"

#include <QActionGroup>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QMenuBar>
#include <QMimeData>
#include <QShortcut>
#include <QStackedWidget>

#include "ui/banner.h"
#include "ui/job_bar.h"
#include "ui/log_panel.h"
#include "ui/model_tools.h"
#include "ui/scene_view.h"
#include "ui/start_page.h"
#include "ui/work_page.h"

namespace gyre {

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle(tr("Gyre"));
  setWindowIcon(themeIcon("scan"));
  setAcceptDrops(true);
  resize(1320, 840);
  pages_ = new QStackedWidget;
  start_page = new StartPage;
  work_page = new WorkPage;
  pages_->addWidget(start_page);
  pages_->addWidget(work_page);
  setCentralWidget(pages_);

  log_panel = new LogPanel;
  auto* dock = new QDockWidget(tr("Log"), this);
  dock->setObjectName("log");
  dock->setWidget(log_panel);
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  dock->hide();

  buildMenus();
  buildShortcuts();
  connect(start_page, &StartPage::newScanRequested, this, &MainWindow::newScanRequested);
  connect(start_page, &StartPage::openRequested, this, &MainWindow::askOpen);
  connect(start_page, &StartPage::recentChosen, this, &MainWindow::openRequested);
  connect(work_page->job_bar, &JobBar::pauseRequested, this, &MainWindow::pauseRequested);
  connect(work_page->job_bar, &JobBar::resumeRequested, this, &MainWindow::resumeRequested);
  connect(work_page->job_bar, &JobBar::stopRequested, this, &MainWindow::stopRequested);
  connect(work_page->banner, &Banner::accepted, this, &MainWindow::stopRequested);
}

void MainWindow::buildMenus() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  file->addAction(tr("&New scan"), QKeySequence::New, this, &MainWindow::newScanRequested);
  file->addAction(themeIcon("open"), tr("&Open…"), QKeySequence::Open, this, &MainWindow::askOpen);
  file->addAction(tr("&Export…"), QKeySequence("Ctrl+E"), this,
                  [this] { showWork(Step::kExport); });
  file->addSeparator();
  file->addAction(tr("&Quit"), QKeySequence::Quit, this, &MainWindow::close);
  buildEditMenu();
  buildViewMenu();
}

// The same actions as over the model, so that keys work and menus tell them.
void MainWindow::buildEditMenu() {
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  const ModelTools& tools = *work_page->model_tools;
  edit->addActions({tools.undo, tools.redo});
  edit->addSeparator();
  edit->addActions({tools.before, tools.hatching, tools.measure});
}

void MainWindow::buildViewMenu() {
  QMenu* view = menuBar()->addMenu(tr("&View"));
  view->addAction(themeIcon("home"), tr("&Start page"), QKeySequence("Ctrl+Home"), this,
                  &MainWindow::showStart);
  QAction* log = findChild<QDockWidget*>("log")->toggleViewAction();
  log->setIcon(themeIcon("log"));
  log->setShortcut(QKeySequence("Ctrl+L"));
  view->addAction(log);
  view->addSeparator();
  const std::pair<QString, ViewSide> sides[] = {
      {tr("From the &front\t1"), ViewSide::kFront}, {tr("From &behind\t2"), ViewSide::kBack},
      {tr("From the &left\t3"), ViewSide::kLeft},   {tr("From the &right\t4"), ViewSide::kRight},
      {tr("From &above\t5"), ViewSide::kTop},       {tr("&Oblique\t6"), ViewSide::kIso}};
  for (const auto& [text, side] : sides) {
    view->addAction(text, work_page->scene_view,
                    [this, side = side] { work_page->scene_view->lookFrom(side); });
  }
  view->addAction(tr("&Whole rig, with the camera\t7"), work_page->scene_view, &SceneView::fitRig);
  view->addAction(tr("F&it the object\tF"), work_page->scene_view, &SceneView::fit);
  view->addSeparator();
  QMenu* theme = view->addMenu(tr("&Colours"));
  auto* group = new QActionGroup(this);
  const std::pair<QString, ThemeChoice> choices[] = {
      {tr("As the &system"), ThemeChoice::kFollowSystem},
      {tr("&Light"), ThemeChoice::kLight},
      {tr("&Dark"), ThemeChoice::kDark}};
  for (const auto& [text, choice] : choices) {
    QAction* action =
        theme->addAction(text, this, [this, choice = choice] { Q_EMIT themeChosen(choice); });
    action->setCheckable(true);
    group->addAction(action);
  }
}

// Only while a scan runs: elsewhere Space presses the focused button.
void MainWindow::buildShortcuts() {
  pause_key_ = new QShortcut(Qt::Key_Space, this);
  stop_key_ = new QShortcut(Qt::Key_Escape, this);
  pause_key_->setEnabled(false);
  stop_key_->setEnabled(false);
  connect(pause_key_, &QShortcut::activated, this, [this] {
    if (phase_ == ScanPhase::kPaused) {
      Q_EMIT resumeRequested();
    } else {
      Q_EMIT pauseRequested();
    }
  });
  connect(stop_key_, &QShortcut::activated, this, &MainWindow::askStop);
}

void MainWindow::askStop() {
  if (phase_ == ScanPhase::kQuickLook) {  // nothing is lost by it
    Q_EMIT stopRequested();
    return;
  }
  work_page->banner->ask(tr("Stop the scan? What was captured is kept, and the scan can go on "
                            "later."),
                         tr("Stop"), tr("Go on"));
}

void MainWindow::showStart() { pages_->setCurrentWidget(start_page); }

void MainWindow::showWork(Step step) {
  pages_->setCurrentWidget(work_page);
  work_page->showStep(step);
}

void MainWindow::showPhase(ScanPhase phase) {
  phase_ = phase;
  work_page->showPhase(phase);
  const bool running = phase == ScanPhase::kScanning || phase == ScanPhase::kPaused;
  pause_key_->setEnabled(running);
  stop_key_->setEnabled(running || phase == ScanPhase::kQuickLook);
}

void MainWindow::askOpen() {
  const QString path = QFileDialog::getOpenFileName(
      this, tr("Open"), QString(),
      tr("Scans and models (*.gyre passes.json *.ply *.obj *.stl);;All files (*)"));
  if (!path.isEmpty()) Q_EMIT openRequested(path);
}

void MainWindow::allowClose() { may_close_ = true; }

void MainWindow::closeEvent(QCloseEvent* event) {
  if (may_close_) {
    event->accept();
    return;
  }
  event->ignore();
  Q_EMIT closeRequested();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QList<QUrl> urls = event->mimeData()->urls();
  if (!urls.isEmpty() && urls.front().isLocalFile()) {
    Q_EMIT openRequested(urls.front().toLocalFile());
  }
}

}  // namespace gyre
