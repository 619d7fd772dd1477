// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/model_tools.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>

#include "ui/theme.h"

namespace gyre {

ModelTools::ModelTools(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2);
  undo = makeAction(tr("&Undo"), QKeySequence("Ctrl+Z"));
  redo = makeAction(tr("&Redo"), QKeySequence("Ctrl+Shift+Z"));
  before = makeAction(tr("As it was &before"), QKeySequence("B"));
  hatching = makeAction(tr("&Hatch what no camera saw"), QKeySequence("H"));
  measure = makeAction(tr("&Measure"), QKeySequence("M"));
  for (QAction* action : {before, hatching, measure}) action->setCheckable(true);
  hatching->setChecked(true);
  addButton(*row, undo);
  addButton(*row, redo);
  addBeforeButton(*row);
  hatching->setToolTip(tr("Hatch what no camera saw (H)"));
  addButton(*row, hatching);
  measure->setToolTip(tr("Measure between two clicks on the model, in mm ± mm (M); Esc ends"));
  addButton(*row, measure);
  fit_ = new QToolButton;
  fit_->setToolTip(tr("Show the whole object (F)"));
  fit_->setAccessibleName(tr("Show the whole object"));
  connect(fit_, &QToolButton::clicked, this, &ModelTools::fitRequested);
  row->addWidget(fit_);
  connect(before, &QAction::toggled, this, [this](bool on) {
    const QSignalBlocker quiet(hold_before_);
    hold_before_->setChecked(on);
    Q_EMIT sideChosen(on ? EditSide::kBefore : EditSide::kAfter);
  });
  drawIcons();
  showFacts({});
  showSurface(0);
}

// In the colour of the text, which is another when the theme is.
void ModelTools::drawIcons() {
  undo->setIcon(themeIcon("undo"));
  redo->setIcon(themeIcon("redo"));
  before->setIcon(themeIcon("before"));
  hold_before_->setIcon(before->icon());
  hatching->setIcon(themeIcon("hatch"));
  measure->setIcon(themeIcon("measure"));
  fit_->setIcon(themeIcon("fit"));
}

void ModelTools::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) drawIcons();
  QWidget::changeEvent(event);
}

QAction* ModelTools::makeAction(const QString& name, const QKeySequence& key) {
  auto* action = new QAction(name, this);
  action->setShortcut(key);
  return action;
}

QToolButton* ModelTools::addButton(QHBoxLayout& row, QAction* action) {
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  button->setToolButtonStyle(Qt::ToolButtonIconOnly);
  button->setAccessibleName(action->text().remove('&'));
  button->setFocusPolicy(Qt::TabFocus);
  row.addWidget(button);
  return button;
}

// Held by mouse or Space it shows what was, as long as it is held; the key B turns it on and off.
void ModelTools::addBeforeButton(QHBoxLayout& row) {
  hold_before_ = new QToolButton;
  hold_before_->setCheckable(true);
  hold_before_->setToolTip(
      tr("Hold to see the surface as it was before the preview or the last step; B turns it on and "
         "off"));
  hold_before_->setAccessibleName(tr("Hold to see the surface as it was before"));
  hold_before_->setFocusPolicy(Qt::TabFocus);
  connect(hold_before_, &QToolButton::pressed, this, [this] { before->setChecked(true); });
  connect(hold_before_, &QToolButton::released, this, [this] { before->setChecked(false); });
  row.addWidget(hold_before_);
}

void ModelTools::showFacts(const EditFacts& facts) {
  undo->setEnabled(!facts.undo.isEmpty());
  redo->setEnabled(!facts.redo.isEmpty());
  undo->setToolTip(facts.undo.isEmpty() ? tr("Nothing to undo (Ctrl+Z)")
                                        : tr("Undo: %1 (Ctrl+Z)").arg(facts.undo));
  redo->setToolTip(facts.redo.isEmpty() ? tr("Nothing to do again (Ctrl+Shift+Z)")
                                        : tr("Do again: %1 (Ctrl+Shift+Z)").arg(facts.redo));
  undo->setText(facts.undo.isEmpty() ? tr("&Undo") : tr("&Undo: %1").arg(facts.undo));
  redo->setText(facts.redo.isEmpty() ? tr("&Redo") : tr("&Redo: %1").arg(facts.redo));
  if (!facts.has_before) before->setChecked(false);
  before->setEnabled(facts.has_before);
  hold_before_->setEnabled(facts.has_before);
}

void ModelTools::showSurface(std::size_t triangles) { hatching->setEnabled(triangles > 0); }

}  // namespace gyre
