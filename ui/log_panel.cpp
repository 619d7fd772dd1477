// What happened, line by line, with its time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/log_panel.h"

#include <QPlainTextEdit>
#include <QTime>
#include <QVBoxLayout>

namespace gyre {

LogPanel::LogPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 0, 8, 8);
  text_ = new QPlainTextEdit;
  text_->setReadOnly(true);
  text_->setMaximumBlockCount(5000);
  text_->setAccessibleName(tr("Log"));
  text_->setPlaceholderText(tr("What happens is written here."));
  layout->addWidget(text_);
}

void LogPanel::addLine(const QString& line) {
  text_->appendPlainText(QTime::currentTime().toString("HH:mm:ss.zzz  ") + line);
}

}  // namespace gyre
