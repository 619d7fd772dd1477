// A strip that says what happened and what to try, or asks, without stopping anything.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

#include "core/base/result.h"

class QLabel;
class QPushButton;

namespace gyre {

// Hidden until there is something to say. Never modal: the table may be turning.
class Banner final : public QFrame {
  Q_OBJECT

 public:
  explicit Banner(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showError(const gyre::Error& error);
  void showNotice(const QString& what, const QString& more);
  // Asks; accepted() follows when the button with the given text is pressed, dismissed() when the
  // other is.
  void ask(const QString& question, const QString& yes, const QString& no);
  void dismiss();

 Q_SIGNALS:
  void accepted();
  void dismissed();

 private:
  enum class Kind { kError, kNotice, kQuestion };
  void present(Kind kind, const QString& what, const QString& more);

  QLabel* sign_;
  QLabel* what_;
  QLabel* more_;
  QPushButton* yes_;
  QPushButton* copy_;
  QPushButton* no_;
};

}  // namespace gyre
