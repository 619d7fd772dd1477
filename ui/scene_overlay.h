// The scale bar, the legends and the measured lines over the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QPointF>
#include <QString>
#include <QWidget>

namespace gyre {

struct OverlayLine {
  QPointF from;
  QPointF to;
  QString text;
};

// Lets every click through to the scene below it.
class SceneOverlay final : public QWidget {
  Q_OBJECT

 public:
  explicit SceneOverlay(QWidget* parent = nullptr);

  // view_height_mm: what the height of the view shows. worst_sigma_mm: end of the legend, 0 hides
  // the legend.
  void setScale(double view_height_mm, double worst_sigma_mm);
  // Explains the hatching; a share of 0 hides the line. [0, 1]
  void setUnseenShare(double share);
  // Lines with a label at their middle, in the overlay's pixels.
  void setLines(std::vector<OverlayLine> lines);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintScaleBar(QPainter& painter) const;
  void paintLegend(QPainter& painter) const;
  void paintUnseen(QPainter& painter) const;
  void paintLine(QPainter& painter, const OverlayLine& line) const;

  double view_height_mm_ = 0.0;
  double worst_sigma_mm_ = 0.0;
  double unseen_share_ = 0.0;
  std::vector<OverlayLine> lines_;
};

}  // namespace gyre
