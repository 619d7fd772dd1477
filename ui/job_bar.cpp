// How far the scan is, in figures, and the three buttons that are always there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/job_bar.h"

#include <QHBoxLayout>
#include <QLocale>
#include <QProgressBar>

#include "ui/parts.h"
#include "ui/theme.h"

namespace gyre {

JobBar::JobBar(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(16, 10, 16, 12);
  layout->setSpacing(8);
  bar_ = new QProgressBar;
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress of the scan"));
  layout->addWidget(bar_);

  auto* row = new QHBoxLayout;
  row->setSpacing(20);
  layout->addLayout(row);
  stage_ = makeLabel(QString(), "muted");
  stage_->setMinimumWidth(150);
  row->addWidget(stage_, 1);
  view_ = addFigure(*row, tr("View"), tr("Captured views of all views of this scan"));
  elapsed_ = addFigure(*row, tr("Elapsed"), tr("Minutes and seconds since the start"));
  left_ = addFigure(*row, tr("Time left"), tr("Expected minutes and seconds to the last view"));
  points_ = addFigure(*row, tr("Points"), tr("Points measured so far"));
  sigma_ = addFigure(*row, tr("Median ±"), tr("Half of the points are surer than this, in mm"));

  start_ = makePrimaryButton(tr("Start"), tr("Start the scan: the table will turn"));
  pause_ = makeButton(tr("Pause"), tr("Hold the table at the next view (Space)"));
  stop_ = makeButton(tr("Stop"), tr("Stop the table and keep what is captured (Esc)"));
  start_->setIcon(themeIcon("start", Qt::white));
  pause_->setIcon(themeIcon("pause"));
  stop_->setIcon(themeIcon("stop"));
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  for (QPushButton* button : {start_, pause_, stop_}) buttons->addWidget(button);
  row->addLayout(buttons);

  connect(start_, &QPushButton::clicked, this, &JobBar::startRequested);
  connect(stop_, &QPushButton::clicked, this, &JobBar::stopRequested);
  connect(pause_, &QPushButton::clicked, this, [this] {
    if (phase_ == ScanPhase::kPaused) {
      Q_EMIT resumeRequested();
    } else {
      Q_EMIT pauseRequested();
    }
  });
  showPhase(ScanPhase::kIdle);
  showFacts({});
}

QLabel* JobBar::addFigure(QLayout& layout, const QString& name, const QString& tip) {
  auto* column = new QVBoxLayout;
  column->setSpacing(0);
  QLabel* figure = makeLabel("–", "figure");
  figure->setWordWrap(false);
  figure->setMinimumWidth(84);
  figure->setToolTip(tip);
  figure->setAccessibleName(name);
  column->addWidget(makeLabel(name, "muted"));
  column->addWidget(figure);
  static_cast<QHBoxLayout&>(layout).addLayout(column);
  return figure;
}

void JobBar::showPhase(ScanPhase phase) {
  phase_ = phase;
  const bool paused = phase == ScanPhase::kPaused;
  start_->setEnabled(phase == ScanPhase::kReady || phase == ScanPhase::kDone ||
                     phase == ScanPhase::kFailed);
  pause_->setEnabled(phase == ScanPhase::kScanning || paused);
  pause_->setText(paused ? tr("Resume") : tr("Pause"));
  pause_->setIcon(themeIcon(paused ? "start" : "pause"));
  stop_->setEnabled(phase == ScanPhase::kScanning || paused || phase == ScanPhase::kConnecting ||
                    phase == ScanPhase::kEmptyTable || phase == ScanPhase::kQuickLook ||
                    phase == ScanPhase::kFinishing || phase == ScanPhase::kMeshing ||
                    phase == ScanPhase::kMerging);
  stage_->setText(phaseText(phase));
}

void JobBar::showFacts(const ScanFacts& facts) {
  facts_ = facts;
  const QString none("–");
  const bool any = facts.views > 0;
  view_->setText(any ? QString("%1 / %2").arg(facts.views_done).arg(facts.views) : none);
  elapsed_->setText(any ? clockText(facts.elapsed_s) : none);
  left_->setText(facts.left_s ? clockText(*facts.left_s) : none);
  points_->setText(facts.points > 0 ? locale().toString(static_cast<qulonglong>(facts.points))
                                    : none);
  sigma_->setText(facts.median_sigma_mm ? tr("%1 mm").arg(*facts.median_sigma_mm, 0, 'f', 3)
                                        : none);
  bar_->setValue(any ? 1000 * facts.views_done / facts.views : 0);
}

void JobBar::showProgress(double fraction, const QString& stage) {
  bar_->setValue(static_cast<int>(1000.0 * fraction));
  stage_->setText(stage);
}

void JobBar::showRest() {
  showPhase(phase_);
  showFacts(ScanFacts(facts_));
}

QString phaseText(ScanPhase phase) {
  switch (phase) {
    case ScanPhase::kIdle:
      return JobBar::tr("Nothing is connected");
    case ScanPhase::kConnecting:
      return JobBar::tr("Connecting…");
    case ScanPhase::kReady:
      return JobBar::tr("Ready to scan");
    case ScanPhase::kEmptyTable:
      return JobBar::tr("Looking at the empty table…");
    case ScanPhase::kQuickLook:
      return JobBar::tr("Looking around the object…");
    case ScanPhase::kScanning:
      return JobBar::tr("Scanning");
    case ScanPhase::kPaused:
      return JobBar::tr("Paused: the table stands still");
    case ScanPhase::kStopping:
      return JobBar::tr("Stopping the table…");
    case ScanPhase::kFinishing:
      return JobBar::tr("Refining the points…");
    case ScanPhase::kMeshing:
      return JobBar::tr("Building the surface…");
    case ScanPhase::kMerging:
      return JobBar::tr("Merging the passes…");
    case ScanPhase::kDone:
      return JobBar::tr("Done");
    case ScanPhase::kFailed:
      return JobBar::tr("Interrupted; what was captured is kept");
  }
  return {};
}

}  // namespace gyre
