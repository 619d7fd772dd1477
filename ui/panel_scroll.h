// A panel in a column that scrolls when it is too tall.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QScrollArea>

namespace gyre {

// Gives the panel the height that its wrapped texts need at the column's width; without it they
// would be squeezed before anything scrolls.
class PanelScroll final : public QScrollArea {
  Q_OBJECT

 public:
  // The panel has a layout; it becomes a child.
  explicit PanelScroll(QWidget* panel, QWidget* parent = nullptr);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fit();
};

}  // namespace gyre
