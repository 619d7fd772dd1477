// A strip that says what happened and what to try, or asks, without stopping anything.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/banner.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>

#include "ui/parts.h"
#include "ui/theme.h"

namespace gyre {

Banner::Banner(QWidget* parent) : QFrame(parent) {
  setObjectName("banner");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 10, 10, 10);
  row->setSpacing(kGap_px);
  sign_ = makeLabel(QString(), "heading");
  row->addWidget(sign_);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  what_ = makeLabel(QString());
  more_ = makeLabel(QString(), "muted");
  what_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  texts->addWidget(what_);
  texts->addWidget(more_);
  row->addLayout(texts, 1);
  yes_ = makePrimaryButton(tr("Yes"), tr("Do what is asked"));
  copy_ = makeButton(tr("Copy details"), tr("Copy this message to the clipboard"));
  no_ = makeButton(tr("Close"), tr("Close this message"));
  for (QPushButton* button : {yes_, copy_, no_}) row->addWidget(button);
  connect(yes_, &QPushButton::clicked, this, [this] {
    hide();
    Q_EMIT accepted();
  });
  connect(no_, &QPushButton::clicked, this, &Banner::dismiss);
  connect(copy_, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(what_->text() + "\n" + more_->text()); });
  hide();
}

void Banner::showError(const Error& error) {
  present(Kind::kError, QString::fromStdString(error.what), QString::fromStdString(error.advice));
}

void Banner::showNotice(const QString& what, const QString& more) {
  present(Kind::kNotice, what, more);
}

void Banner::ask(const QString& question, const QString& yes, const QString& no) {
  present(Kind::kQuestion, question, QString());
  yes_->setText(yes);
  no_->setText(no);
  yes_->setFocus();
}

void Banner::dismiss() {
  if (isHidden()) return;
  hide();
  Q_EMIT dismissed();
}

void Banner::present(Kind kind, const QString& what, const QString& more) {
  const ThemeColours colours = themeColours();
  const QColor colour = kind == Kind::kError      ? colours.bad
                        : kind == Kind::kQuestion ? colours.warning
                                                  : colours.accent;
  sign_->setText(kind == Kind::kError ? "!" : kind == Kind::kQuestion ? "?" : "i");
  what_->setText(what);
  more_->setText(more);
  more_->setVisible(!more.isEmpty());
  yes_->setVisible(kind == Kind::kQuestion);
  copy_->setVisible(kind == Kind::kError);
  no_->setText(tr("Close"));
  setStyleSheet(QString("#banner { background: %1; border: 1px solid %2; border-left: 4px solid %2;"
                        " border-radius: 8px; }")
                    .arg(colours.card.name(), colour.name()));
  show();
}

}  // namespace gyre
