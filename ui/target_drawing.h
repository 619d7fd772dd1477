// A drawing of the target on which one corner is pointed out.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/scan/target_sketch.h"

namespace gyre {

class TargetDrawing final : public QWidget {
  Q_OBJECT

 public:
  explicit TargetDrawing(QWidget* parent = nullptr);

  // Corners that were asked for before the given one are drawn as done. asked: index into
  // sketch.to_click.
  void ask(const TargetSketch& sketch, int asked);

  QSize sizeHint() const override { return {220, 180}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  TargetSketch sketch_;
  int asked_ = 0;
};

}  // namespace gyre
