// The small buttons over the 3D view: undo, redo, before, hatching, measuring, fit.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/facts.h"

class QAction;
class QHBoxLayout;
class QToolButton;

namespace gyre {

// Its actions stand in the window's Edit menu too, with their keys.
class ModelTools final : public QWidget {
  Q_OBJECT

 public:
  explicit ModelTools(QWidget* parent = nullptr);

  QAction* undo;
  QAction* redo;
  QAction* before;    // checked while the surface is shown as it was; its button by holding it
  QAction* hatching;  // checked while what no camera saw is hatched
  QAction* measure;   // checked while clicks measure

 public Q_SLOTS:
  void showFacts(const gyre::EditFacts& facts);
  void showSurface(std::size_t triangles);  // 0: there is none

 Q_SIGNALS:
  void sideChosen(gyre::EditSide side);
  void fitRequested();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QAction* makeAction(const QString& name, const QKeySequence& key);
  void drawIcons();
  QToolButton* addButton(QHBoxLayout& row, QAction* action);
  void addBeforeButton(QHBoxLayout& row);

  QToolButton* hold_before_;
  QToolButton* fit_;
};

}  // namespace gyre
