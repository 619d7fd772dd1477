// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/focus_panel.h"

#include <algorithm>

#include <QComboBox>
#include <QIcon>
#include <QVBoxLayout>

#include "ui/meter.h"
#include "ui/parts.h"

namespace gyre {
namespace {

constexpr QSize kPicture_px(240, 120);
// Below this share of the sharpest moment the lens was visibly better focused before.
constexpr double kSharpEnough = 0.8;
constexpr double kHardlySharp = 0.5;
// Shares of the picture without detail that cost nothing, and that cost much.
constexpr double kFewBlank = 0.01;
constexpr double kManyBlank = 0.05;

MeterState sharpnessState(double sharpness) {
  if (sharpness >= kSharpEnough) return MeterState::kGood;
  return sharpness >= kHardlySharp ? MeterState::kWarning : MeterState::kBad;
}

MeterState blankState(double share) {
  if (share <= kFewBlank) return MeterState::kGood;
  return share <= kManyBlank ? MeterState::kWarning : MeterState::kBad;
}

QString controlText(const ControlState& control) {
  const QString name = QString::fromStdString(control.name);
  if (control.locked) {
    const QString value = control.word.empty() ? QString::number(control.value)
                                               : QString::fromStdString(control.word);
    return FocusPanel::tr("✓ %1: locked at %2").arg(name, value);
  }
  const QString remark = QString::fromStdString(control.remark);
  return remark.isEmpty() ? FocusPanel::tr("✗ %1: not locked").arg(name)
                          : FocusPanel::tr("✗ %1: %2").arg(name, remark);
}

}  // namespace

FocusPanel::FocusPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGap_px);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  auto* drawing = new QLabel;
  drawing->setPixmap(QIcon(":/wizard/focus.svg").pixmap(kPicture_px, devicePixelRatio()));
  card->addWidget(drawing, 0, Qt::AlignHCenter);
  card->addWidget(makeLabel(tr("Frame and focus the object"), "heading"));
  card->addWidget(
      makeLabel(tr("Put the object on the table. Move the camera until the object fills most of "
                   "the picture at every turn, then turn the lens until it is sharpest. Lock the "
                   "camera: from here on it may not be touched.")));
  buildModes(*card);
  sharpness_ = new Meter(tr("Sharpness"));
  exposure_ = new Meter(tr("Exposure"));
  advice_ = makeLabel(QString());
  lock_ = makePrimaryButton(tr("&Lock the camera"),
                            tr("Keep focus, exposure, gain and white balance as they are, and read "
                               "them back"));
  locks_ = makeLabel(QString(), "muted");
  go_on_ = makeButton(tr("Go on to calibrating"), tr("To the next step"));
  for (QWidget* part : {static_cast<QWidget*>(sharpness_), static_cast<QWidget*>(exposure_),
                        static_cast<QWidget*>(advice_), static_cast<QWidget*>(lock_),
                        static_cast<QWidget*>(locks_), static_cast<QWidget*>(go_on_)}) {
    card->addWidget(part);
  }
  layout->addStretch(1);
  connect(lock_, &QPushButton::clicked, this, &FocusPanel::lockRequested);
  connect(go_on_, &QPushButton::clicked, this, &FocusPanel::goOnRequested);
  showPhase(ScanPhase::kIdle);
}

void FocusPanel::buildModes(QLayout& card) {
  size_ = makeLabel(QString(), "muted");
  card.addWidget(size_);
  modes_row_ = new QWidget;
  auto* column = new QVBoxLayout(modes_row_);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(makeLabel(tr("Size, format and pictures a second")));
  modes_ = new QComboBox;
  modes_->setAccessibleName(tr("Size, format and pictures a second"));
  modes_->setToolTip(tr("Larger pictures show finer detail; the camera is opened anew"));
  column->addWidget(modes_);
  card.addWidget(modes_row_);
  connect(modes_, &QComboBox::activated, this, [this](int index) {
    const QString mode = modes_->itemData(index).toString();
    if (mode != modes_->property("now").toString()) Q_EMIT modeChosen(mode);
  });
}

void FocusPanel::reset() {
  sharpness_->show(0.0, MeterState::kWarning, tr("waiting for a picture"));
  exposure_->show(0.0, MeterState::kWarning, tr("waiting for a picture"));
  advice_->hide();
  locks_->setText(QString());
  locks_->hide();
  go_on_->setEnabled(false);
}

void FocusPanel::showPhase(ScanPhase phase) {
  const bool at_rest =
      phase == ScanPhase::kReady || phase == ScanPhase::kDone || phase == ScanPhase::kFailed;
  lock_->setEnabled(at_rest);
  modes_->setEnabled(at_rest);
  if (phase != ScanPhase::kIdle) return;
  reset();
  size_->setText(tr("Connect turntable and camera first (step 1)."));
  modes_row_->hide();
}

void FocusPanel::showCamera(const CameraInfo& camera) {
  reset();
  QString text = tr("Pictures of %1 × %2 px").arg(camera.width_px).arg(camera.height_px);
  if (camera.frames_per_s > 0.0) {
    text += tr(", %1 a second").arg(camera.frames_per_s, 0, 'g', 3);
  }
  size_->setText(text);
  modes_->clear();
  int now = -1;
  for (const std::string& mode : camera.modes) {
    const QString word = QString::fromStdString(mode);
    modes_->addItem(QString(word).replace('x', " × ").replace('@', ", "), word);
    if (now < 0 && !camera.mode.empty() && mode.starts_with(camera.mode)) now = modes_->count() - 1;
  }
  modes_->setCurrentIndex(now);
  modes_->setProperty("now", modes_->currentData());
  modes_row_->setVisible(camera.modes.size() > 1);
}

void FocusPanel::showFocus(const FocusFacts& facts) {
  sharpness_->show(facts.sharpness, sharpnessState(facts.sharpness),
                   tr("%1 % of the best so far").arg(qRound(100.0 * facts.sharpness)));
  const double blank = std::max(facts.too_bright, facts.too_dark);
  const QString share = QString::number(100.0 * blank, 'f', 1);
  exposure_->show(1.0 - blank, blankState(blank),
                  blank <= kFewBlank                  ? tr("good")
                  : facts.too_bright > facts.too_dark ? tr("%1 % too bright").arg(share)
                                                      : tr("%1 % too dark").arg(share));
  advice_->setText(facts.advice);
  advice_->setVisible(!facts.advice.isEmpty());
}

void FocusPanel::showLocks(const CameraInfo& camera) {
  QStringList lines;
  for (const ControlState& control : camera.controls) lines.append(controlText(control));
  if (lines.isEmpty()) lines.append(tr("This camera has no controls to lock: set it by hand."));
  locks_->setText(lines.join('\n'));
  locks_->show();
  go_on_->setEnabled(true);
}

}  // namespace gyre
