// The window: start page or work page, menus, log. Behaviour is wired from outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMainWindow>

#include "ui/facts.h"
#include "ui/theme.h"

class QShortcut;
class QStackedWidget;

namespace gyre {

class LogPanel;
class StartPage;
class WorkPage;

// Closing is a wish like any other: closeRequested() is sent until allowClose() was called.
class MainWindow final : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(QWidget* parent = nullptr);

  StartPage* start_page;
  WorkPage* work_page;
  LogPanel* log_panel;

  void allowClose();

 public Q_SLOTS:
  void showStart();
  void showWork(gyre::Step step);
  void showPhase(gyre::ScanPhase phase);
  void askOpen();

 Q_SIGNALS:
  void newScanRequested();
  void openRequested(const QString& path);  // a scan folder, a .gyre file, a .ply, .obj or .stl
  void pauseRequested();
  void resumeRequested();
  void stopRequested();
  void closeRequested();
  void themeChosen(gyre::ThemeChoice choice);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void buildMenus();
  void buildEditMenu();
  void buildViewMenu();
  void buildShortcuts();
  void askStop();

  QStackedWidget* pages_;
  QShortcut* pause_key_;
  QShortcut* stop_key_;
  ScanPhase phase_ = ScanPhase::kIdle;
  bool may_close_ = false;
};

}  // namespace gyre
