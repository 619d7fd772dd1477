// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/focus_page.h"

#include <algorithm>

#include <QVBoxLayout>

#include "ui/meter.h"
#include "ui/parts.h"

namespace gyre {
namespace {

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
  if (control.locked) return FocusPage::tr("✓ %1: locked").arg(name);
  const QString remark = QString::fromStdString(control.remark);
  return remark.isEmpty() ? FocusPage::tr("✗ %1: not locked").arg(name)
                          : FocusPage::tr("✗ %1: %2").arg(name, remark);
}

}  // namespace

FocusPage::FocusPage()
    : WizardPage(tr("Frame and focus the object"), "focus",
                 tr("Put the object on the table. Move the camera until the object fills most of "
                    "the picture at every turn, then turn the lens until it is sharpest. Lock the "
                    "camera: from here on it may not be touched.")) {
  sharpness_ = new Meter(tr("Sharpness"));
  exposure_ = new Meter(tr("Exposure"));
  advice_ = makeLabel(QString());
  auto* lock = makeButton(tr("&Lock the camera"),
                          tr("Keep focus, exposure, gain and white balance as they are"));
  locks_ = makeLabel(QString(), "muted");
  for (QWidget* part : {static_cast<QWidget*>(sharpness_), static_cast<QWidget*>(exposure_),
                        static_cast<QWidget*>(advice_), static_cast<QWidget*>(lock),
                        static_cast<QWidget*>(locks_)}) {
    body().addWidget(part);
  }
  body().addStretch(1);
  connect(lock, &QPushButton::clicked, this, &FocusPage::lockRequested);
  sharpness_->show(0.0, MeterState::kWarning, tr("waiting for a picture"));
  exposure_->show(0.0, MeterState::kWarning, tr("waiting for a picture"));
}

QString FocusPage::hindrance() const { return locked_ ? QString() : tr("Lock the camera first."); }

void FocusPage::showFocus(const FocusFacts& facts) {
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

void FocusPage::showLocks(const CameraInfo& camera) {
  QStringList lines;
  for (const ControlState& control : camera.controls) lines.append(controlText(control));
  if (lines.isEmpty()) lines.append(tr("This camera has no controls to lock: set it by hand."));
  locks_->setText(lines.join('\n'));
  locked_ = true;
  Q_EMIT hindranceChanged();
}

}  // namespace gyre
