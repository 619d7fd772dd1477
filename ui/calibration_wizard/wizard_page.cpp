// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/wizard_page.h"

#include <QIcon>
#include <QLabel>
#include <QVBoxLayout>

#include "ui/parts.h"

namespace gyre {
namespace {

constexpr QSize kPicture_px(240, 120);

}  // namespace

WizardPage::WizardPage(const QString& title, const QString& picture, const QString& instruction)
    : title_(title) {
  body_ = new QVBoxLayout(this);
  body_->setContentsMargins(0, 0, 0, 0);
  body_->setSpacing(8);
  auto* drawing = new QLabel;
  drawing->setPixmap(QIcon(":/wizard/" + picture + ".svg").pixmap(kPicture_px, devicePixelRatio()));
  body_->addWidget(drawing, 0, Qt::AlignHCenter);
  body_->addWidget(makeLabel(title, "heading"));
  body_->addWidget(makeLabel(instruction));
}

}  // namespace gyre
