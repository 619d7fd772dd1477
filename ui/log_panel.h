// What happened, line by line, with its time.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QPlainTextEdit;

namespace gyre {

class LogPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit LogPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void addLine(const QString& line);

 private:
  QPlainTextEdit* text_;
};

}  // namespace gyre
