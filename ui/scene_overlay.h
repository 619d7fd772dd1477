// The scale bar and the colour legend over the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace gyre {

// Lets every click through to the scene below it.
class SceneOverlay final : public QWidget {
  Q_OBJECT

 public:
  explicit SceneOverlay(QWidget* parent = nullptr);

  // view_height_mm: what the height of the view shows. worst_sigma_mm: end of the legend, 0 hides
  // the legend.
  void setScale(double view_height_mm, double worst_sigma_mm);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintScaleBar(QPainter& painter) const;
  void paintLegend(QPainter& painter) const;

  double view_height_mm_ = 0.0;
  double worst_sigma_mm_ = 0.0;
};

}  // namespace gyre
