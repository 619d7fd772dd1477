// The scale bar, the legends and the measured lines over the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_overlay.h"

#include <cmath>
#include <utility>

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

void SceneOverlay::setUnseenShare(double share) {
  if (share == unseen_share_) return;
  unseen_share_ = share;
  update();
}

void SceneOverlay::setLines(std::vector<OverlayLine> lines) {
  if (lines.empty() && lines_.empty()) return;
  lines_ = std::move(lines);
  update();
}

void SceneOverlay::paintEvent(QPaintEvent*) {
  if (view_height_mm_ <= 0.0) return;
  QPainter painter(this);
  painter.setPen(palette().color(QPalette::WindowText));
  paintScaleBar(painter);
  if (worst_sigma_mm_ > 0.0) paintLegend(painter);
  if (unseen_share_ > 0.0) paintUnseen(painter);
  for (const OverlayLine& line : lines_) paintLine(painter, line);
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

void SceneOverlay::paintUnseen(QPainter& painter) const {
  const QRect swatch(kMargin_px, kMargin_px, 26, 16);
  painter.fillRect(swatch, QColor(150, 158, 168));
  painter.save();
  painter.setClipRect(swatch);
  painter.setRenderHint(QPainter::Antialiasing);
  for (int x = swatch.left() - swatch.height(); x < swatch.right(); x += 8) {
    painter.setPen(QPen(QColor(20, 26, 36), 3.0));
    painter.drawLine(x, swatch.top(), x + swatch.height(), swatch.bottom() + 1);
  }
  painter.restore();
  painter.drawRect(swatch);
  const QString share =
      unseen_share_ < 0.0005 ? tr("under 0.1") : QString::number(100.0 * unseen_share_, 'f', 1);
  painter.drawText(QRect(swatch.right() + 8, swatch.top() - 3, width(), 22),
                   Qt::AlignLeft | Qt::AlignVCenter,
                   tr("seen by no camera: %1 % of the area").arg(share));
}

// The line is seen through the surface, or half of it would often be hidden.
void SceneOverlay::paintLine(QPainter& painter, const OverlayLine& line) const {
  const QColor ink(255, 214, 92);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& [colour, width] : {std::pair(QColor(20, 26, 36), 4.0), std::pair(ink, 2.0)}) {
    painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(line.from, line.to);
    for (const QPointF& end : {line.from, line.to}) painter.drawEllipse(end, 4.0, 4.0);
  }
  if (!line.text.isEmpty()) {
    QRectF box = painter.fontMetrics().boundingRect(line.text);
    box.adjust(-7.0, -4.0, 7.0, 4.0);
    box.moveCenter(0.5 * (line.from + line.to) + QPointF(0.0, -18.0));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 26, 36, 225));
    painter.drawRoundedRect(box, 5.0, 5.0);
    painter.setPen(Qt::white);
    painter.drawText(box, Qt::AlignCenter, line.text);
  }
  painter.restore();
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
