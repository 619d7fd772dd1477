// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health_words.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

namespace gyre {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("MeshHealth", text); }

QString number(std::size_t count) { return QLocale().toString(static_cast<qulonglong>(count)); }

QString closedText(const MeshHealth& health) {
  return health.closed ? tr("✓ closed, %1 cm³").arg(health.volume_mm3 / 1000.0, 0, 'f', 2)
                       : tr("⚠ open, rims of holes: %1").arg(number(health.holes));
}

std::size_t touches(const MeshHealth& health) {
  return health.non_manifold_edges + health.non_manifold_vertices;
}

QString touchText(const MeshHealth& health) {
  return touches(health) == 0
             ? tr("✓ manifold: touches itself nowhere")
             : tr("⚠ touches itself at %1 edges or corners").arg(number(touches(health)));
}

QString crossingText(std::size_t pairs) {
  return pairs == 0 ? tr("✓ passes through itself nowhere")
                    : tr("⚠ passes through itself: %1 pairs of triangles").arg(number(pairs));
}

QString pieceText(const MeshHealth& health) {
  return health.components == 1 ? tr("✓ one piece")
                                : tr("⚠ %1 pieces").arg(number(health.components));
}

QString unseenText(const MeshHealth& health) {
  return tr("%1 % of the area was not seen by any camera")
      .arg(100.0 * unseenShare(health), 0, 'f', 1);
}

// "holes filled 3, area filled 12.4 mm²"; empty when nothing happened.
QString figuresText(const CleanStep& step) {
  QStringList texts;
  for (const CleanFigure& figure : step.figures) {
    if (figure.value == 0.0) continue;
    QString text = QString::fromStdString(figure.what) + ' ' +
                   (figure.unit.empty() ? number(static_cast<std::size_t>(figure.value))
                                        : QLocale().toString(figure.value, 'g', 3));
    if (!figure.unit.empty()) {
      text += ' ' + QString::fromStdString(figure.unit).replace("^2", "²").replace("^3", "³");
    }
    texts.append(text);
  }
  return texts.join(", ");
}

// "Holes: 3 → 0"; empty when nothing changed.
QString changeText(const QString& what, const QString& before, const QString& after) {
  return before == after ? QString() : what + ": " + before + " → " + after;
}

QString area(double mm2) {
  return QCoreApplication::translate("MeshHealth", "%1 cm²").arg(mm2 / 100.0, 0, 'f', 1);
}

QString volume(const MeshHealth& health) {
  return health.closed ? tr("%1 cm³").arg(health.volume_mm3 / 1000.0, 0, 'f', 2) : tr("open");
}

QString percent(double share) { return tr("%1 %").arg(100.0 * share, 0, 'f', 1); }

}  // namespace

QString healthText(const MeshHealth& health) {
  QStringList lines = {
      tr("%1 vertices, %2 triangles, %3")
          .arg(number(health.vertices), number(health.triangles), area(health.area_mm2)),
      closedText(health), touchText(health), pieceText(health)};
  if (health.self_intersections) lines.insert(3, crossingText(*health.self_intersections));
  if (health.unseen_area_mm2 > 0.0) lines.append(unseenText(health));
  return lines.join('\n');
}

QString cleanText(const CleanReport& report) {
  QStringList lines;
  for (const CleanStep& step : report.steps) {
    const QString figures = figuresText(step);
    if (!figures.isEmpty()) lines.append(QString::fromStdString(step.name) + ": " + figures);
  }
  const MeshHealth& before = report.before;
  const MeshHealth& after = report.after;
  const QStringList changes = {
      changeText(tr("Triangles"), number(before.triangles), number(after.triangles)),
      changeText(tr("Pieces"), number(before.components), number(after.components)),
      changeText(tr("Holes"), number(before.holes), number(after.holes)),
      changeText(tr("Touching places"), number(touches(before)), number(touches(after))),
      changeText(tr("Volume"), volume(before), volume(after)),
      changeText(tr("Area"), area(before.area_mm2), area(after.area_mm2)),
      changeText(tr("Not seen"), percent(unseenShare(before)), percent(unseenShare(after)))};
  bool any = !lines.isEmpty();
  for (const QString& change : changes) {
    if (change.isEmpty()) continue;
    lines.append(change);
    any = true;
  }
  return any ? lines.join('\n') : tr("This changes nothing.");
}

double unseenShare(const MeshHealth& health) {
  return health.area_mm2 > 0.0 ? health.unseen_area_mm2 / health.area_mm2 : 0.0;
}

}  // namespace gyre
