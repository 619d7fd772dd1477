// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/meter.h"

#include <algorithm>

#include <QPainter>

#include "ui/theme.h"

namespace gyre {
namespace {

constexpr int kBar_px = 8;

QColor colourOf(MeterState state) {
  const ThemeColours colours = themeColours();
  switch (state) {
    case MeterState::kGood:
      return colours.good;
    case MeterState::kWarning:
      return colours.warning;
    case MeterState::kBad:
      return colours.bad;
  }
  return colours.muted;
}

}  // namespace

Meter::Meter(const QString& name, QWidget* parent) : QWidget(parent), name_(name) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(name);
}

void Meter::show(double share, MeterState state, const QString& word) {
  share_ = std::clamp(share, 0.0, 1.0);
  state_ = state;
  word_ = word;
  setAccessibleDescription(word);
  update();
}

void Meter::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRect words = rect().adjusted(0, 0, 0, -kBar_px - 4);
  painter.setPen(themeColours().muted);
  painter.drawText(words, Qt::AlignLeft | Qt::AlignVCenter, name_);
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(words, Qt::AlignRight | Qt::AlignVCenter, word_);
  QRectF bar(0, height() - kBar_px, width(), kBar_px);
  painter.setPen(Qt::NoPen);
  painter.setBrush(themeColours().line);
  painter.drawRoundedRect(bar, kBar_px / 2.0, kBar_px / 2.0);
  bar.setWidth(std::max<double>(kBar_px, share_ * width()));
  painter.setBrush(colourOf(state_));
  painter.drawRoundedRect(bar, kBar_px / 2.0, kBar_px / 2.0);
}

}  // namespace gyre
