// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panel_scroll.h"

#include <QEvent>
#include <QLayout>

namespace gyre {

PanelScroll::PanelScroll(QWidget* panel, QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFocusPolicy(Qt::NoFocus);
  setWidget(panel);
}

bool PanelScroll::eventFilter(QObject* watched, QEvent* event) {
  if (watched == widget() && event->type() == QEvent::LayoutRequest) fit();
  return QScrollArea::eventFilter(watched, event);
}

void PanelScroll::resizeEvent(QResizeEvent* event) {
  fit();
  QScrollArea::resizeEvent(event);
}

void PanelScroll::fit() {
  const QLayout* layout = widget() != nullptr ? widget()->layout() : nullptr;
  if (layout == nullptr) return;
  const int width = viewport()->width();
  widget()->setMinimumHeight(layout->hasHeightForWidth() ? layout->totalHeightForWidth(width)
                                                         : layout->totalSizeHint().height());
}

}  // namespace gyre
