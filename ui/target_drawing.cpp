// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/target_drawing.h"

#include <algorithm>

#include <QPainter>

#include "ui/theme.h"

namespace gyre {
namespace {

constexpr double kMargin_px = 12.0;
constexpr double kCorner_px = 2.0;
constexpr double kDone_px = 4.0;
constexpr double kAsked_px = 8.0;
const QColor kInk(0x50, 0x54, 0x5a);  // paler than print, so that the marks stand out

}  // namespace

TargetDrawing::TargetDrawing(QWidget* parent) : QWidget(parent) {
  setMinimumSize(160, 140);
  setAccessibleName(tr("Drawing of the target with the corner to click"));
}

void TargetDrawing::ask(const TargetSketch& sketch, int asked) {
  sketch_ = sketch;
  asked_ = asked;
  update();
}

void TargetDrawing::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const ThemeColours colours = themeColours();
  const double side = std::min(width(), height()) - 2.0 * kMargin_px;
  const auto at = [&](const Eigen::Vector2d& place) {
    return QPointF(0.5 * width() + side * (place.x() - 0.5),
                   0.5 * height() + side * (place.y() - 0.5));
  };
  const auto polygon_of = [&](const std::vector<Eigen::Vector2d>& outline) {
    QPolygonF polygon;
    for (const Eigen::Vector2d& place : outline) polygon << at(place);
    return polygon;
  };
  for (const TargetSketch::Face& face : sketch_.faces) {
    painter.setPen(QPen(colours.muted, 1.0));
    painter.setBrush(Qt::white);  // paper, whatever the theme
    painter.drawPolygon(polygon_of(face.outline));
    painter.setPen(Qt::NoPen);
    for (const TargetSketch::Area& area : face.print) {
      painter.setBrush(area.dark ? kInk : QColor(Qt::white));
      painter.drawPolygon(polygon_of(area.outline));
    }
  }
  // Where squares are drawn, their corners are seen.
  const bool plain = std::all_of(sketch_.faces.begin(), sketch_.faces.end(),
                                 [](const auto& face) { return face.print.empty(); });
  for (const TargetSketch::Corner& corner : sketch_.corners) {
    const auto found =
        std::find(sketch_.to_click.begin(), sketch_.to_click.end(), corner.corner_id);
    const auto turn = static_cast<int>(found - sketch_.to_click.begin());
    const bool wanted = found != sketch_.to_click.end();
    painter.setPen(Qt::NoPen);
    painter.setBrush(colours.muted);
    if (wanted && turn < asked_) {  // done: filled
      painter.setBrush(colours.accent);
      painter.drawEllipse(at(corner.place), kDone_px, kDone_px);
    } else if (wanted && turn == asked_) {  // asked for: a ring with a dot
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(colours.accent, 2.5));
      painter.drawEllipse(at(corner.place), kAsked_px, kAsked_px);
      painter.drawPoint(at(corner.place));
    } else if (plain) {
      painter.drawEllipse(at(corner.place), kCorner_px, kCorner_px);
    }
  }
}

}  // namespace gyre
