// The scale bar and the colour legend over the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_overlay.h"

#include <cmath>

#include <QLinearGradient>
#include <QPainter>

#include "ui/cloud_actors.h"

namespace gyre {
namespace {

constexpr int kMargin_px = 14;

// The longest of 1, 2, 5 times a power of ten that does not exceed the length.
double roundLengthMm(double longest_mm) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_mm)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= longest_mm) return step * decade;
  }
  return decade;
}

}  // namespace

SceneOverlay::SceneOverlay(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
}

void SceneOverlay::setScale(double view_height_mm, double worst_sigma_mm) {
  if (view_height_mm == view_height_mm_ && worst_sigma_mm == worst_sigma_mm_) return;
  view_height_mm_ = view_height_mm;
  worst_sigma_mm_ = worst_sigma_mm;
  update();
}

void SceneOverlay::paintEvent(QPaintEvent*) {
  if (view_height_mm_ <= 0.0) return;
  QPainter painter(this);
  painter.setPen(palette().color(QPalette::WindowText));
  paintScaleBar(painter);
  if (worst_sigma_mm_ > 0.0) paintLegend(painter);
}

void SceneOverlay::paintScaleBar(QPainter& painter) const {
  const double mm_per_px = view_height_mm_ / height();
  const double length_mm = roundLengthMm(mm_per_px * 140.0);
  const int length_px = static_cast<int>(std::lround(length_mm / mm_per_px));
  const int right = width() - kMargin_px;
  const int y = height() - kMargin_px;
  painter.drawLine(right - length_px, y, right, y);
  painter.drawLine(right - length_px, y - 4, right - length_px, y);
  painter.drawLine(right, y - 4, right, y);
  painter.drawText(QRect(right - 200, y - 26, 200, 20), Qt::AlignRight | Qt::AlignVCenter,
                   tr("%1 mm").arg(length_mm));
}

void SceneOverlay::paintLegend(QPainter& painter) const {
  constexpr int kBarWidth_px = 12;
  constexpr int kBarHeight_px = 140;
  const QRect bar(width() - kMargin_px - kBarWidth_px, kMargin_px + 22, kBarWidth_px,
                  kBarHeight_px);
  QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
  for (int i = 0; i <= 12; ++i) {
    const Rgb rgb = uncertaintyColour(i / 12.0);
    gradient.setColorAt(i / 12.0, QColor(rgb[0], rgb[1], rgb[2]));
  }
  painter.fillRect(bar, gradient);
  const QRect label(bar.left() - 96, 0, 90, 18);
  const auto text = [&](double share) {
    return tr("± %1 mm").arg(share * worst_sigma_mm_, 0, 'f', worst_sigma_mm_ < 0.1 ? 3 : 2);
  };
  painter.drawText(label.translated(0, bar.top() - 3), Qt::AlignRight, text(1.0));
  painter.drawText(label.translated(0, bar.bottom() - 12), Qt::AlignRight, text(0.0));
}

}  // namespace gyre
