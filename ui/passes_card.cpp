// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/passes_card.h"

#include <QFileDialog>
#include <QScrollArea>
#include <QTimer>

#include "ui/parts.h"

namespace gyre {
namespace {

constexpr int kNameWidth_px = 150;

// At rest, whether or not something is connected.
bool mayBegin(ScanPhase phase) {
  return phase == ScanPhase::kIdle || phase == ScanPhase::kReady || phase == ScanPhase::kDone ||
         phase == ScanPhase::kFailed;
}

QString nameOf(const ScanPass& pass) {
  return QString::fromStdString(pass.folder.filename().string());
}

}  // namespace

PassesCard::PassesCard(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  build();
  connect(turn_over_, &QPushButton::clicked, this, &PassesCard::turnOverRequested);
  connect(merge_, &QPushButton::clicked, this, &PassesCard::mergeRequested);
  connect(merge_with_, &QPushButton::clicked, this, &PassesCard::askForPass);
  connect(stop_, &QPushButton::clicked, this, &PassesCard::stopRequested);
  offer();
}

void PassesCard::build() {
  auto* card = new QVBoxLayout(this);
  card->setContentsMargins(16, 14, 16, 14);
  card->setSpacing(kGap_px - 4);
  card->addWidget(makeLabel(tr("The side it stands on"), "heading"));
  card->addWidget(
      makeLabel(tr("It is in no picture. Turn the object over, scan it again, and merge both "
                   "passes into one model."),
                "muted"));
  merge_ = makePrimaryButton(QString(), tr("Lay both passes on each other and make one surface"));
  turn_over_ = makeButton(tr("Turn it over and scan again"),
                          tr("A second pass beside this one, with the same rig and calibration"));
  merge_with_ = makeButton(tr("Merge with another pass…"),
                           tr("Choose the folder of another finished scan of this object"));
  stop_ = makeButton(tr("Stop merging"), tr("Nothing is lost: the passes stay as they are"));
  told_ = makeLabel(QString());
  told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  told_->setAccessibleName(tr("What merging told"));
  told_->hide();
  for (QWidget* part : {static_cast<QWidget*>(merge_), static_cast<QWidget*>(turn_over_),
                        static_cast<QWidget*>(merge_with_), static_cast<QWidget*>(stop_),
                        static_cast<QWidget*>(told_)}) {
    card->addWidget(part);
  }
}

void PassesCard::showPhase(ScanPhase phase) {
  phase_ = phase;
  if (phase == ScanPhase::kMerging) told_->hide();
  offer();
}

void PassesCard::showOffer(const PassOffer& now) {
  offer_ = now;
  offer();
}

void PassesCard::offer() {
  const bool merging = phase_ == ScanPhase::kMerging;
  const bool may = offer_.finished && mayBegin(phase_);
  merge_->setText(tr("Merge with %1")
                      .arg(fontMetrics().elidedText(offer_.with, Qt::ElideMiddle, kNameWidth_px)));
  merge_->setVisible(!offer_.with.isEmpty() && !merging);
  stop_->setVisible(merging);
  stop_->setEnabled(merging);
  for (QPushButton* button : {merge_, turn_over_, merge_with_}) button->setEnabled(may);
}

void PassesCard::askForPass() {
  auto* dialog = new QFileDialog(this, tr("The folder of another pass"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, &PassesCard::mergeWithRequested);
  dialog->open();
}

void PassesCard::showPasses(const std::vector<ScanPass>& passes) { tell(passWords(passes)); }

void PassesCard::showRefusal(const Error& error) {
  tell(tr("Not merged; the passes stay as they are. %1")
           .arg(QString::fromStdString(error.sentence())));
}

void PassesCard::tell(const QString& text) {
  told_->setText(text);
  told_->setVisible(!text.isEmpty());
  if (!text.isEmpty()) QTimer::singleShot(0, this, &PassesCard::reveal);  // once it is laid out
}

// What was waited for is seen, however small the window is.
void PassesCard::reveal() {
  for (QWidget* above = parentWidget(); above != nullptr; above = above->parentWidget()) {
    if (auto* scroll = qobject_cast<QScrollArea*>(above)) {
      scroll->ensureWidgetVisible(told_);
      return;
    }
  }
}

QString passWords(const std::vector<ScanPass>& passes) {
  QStringList lines;
  for (const ScanPass& pass : passes) {
    if (!pass.fit) continue;
    lines << PassesCard::tr(
                 "✓ %1: it overlaps by %2 %, and is %3 mm apart there (median). %4 spots "
                 "of its surface were found again.")
                 .arg(nameOf(pass))
                 .arg(100.0 * pass.fit->overlap, 0, 'f', 0)
                 .arg(pass.fit->residual_mm, 0, 'f', 3)
                 .arg(pass.fit->spots);
  }
  if (lines.isEmpty()) return {};
  lines << PassesCard::tr("It stands as in %1.").arg(nameOf(passes.front()));
  return lines.join('\n');
}

}  // namespace gyre
