// Draws the 3D scene without any screen and shows it as a picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QTimer>

#include <vtkNew.h>

#include "ui/egl_tolerant_window.h"
#include "ui/scene_canvas.h"

namespace gyre {

// Renders into memory by EGL without a surface: works with no X server and no Wayland.
class ImageCanvas final : public QWidget, public SceneCanvas {
  Q_OBJECT

 public:
  explicit ImageCanvas(QWidget* parent = nullptr);
  ~ImageCanvas() override;

  // False when this machine has no EGL that renders.
  bool works() const;

  QWidget* widget() override { return this; }
  vtkRenderWindow* window() override { return window_; }
  void requestRender() override;
  QImage picture() override;
  bool rendersInSoftware() override { return window_->rendersInSoftware(); }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  class EglContext;

  void makeVtkCurrent(vtkObject* caller, unsigned long event, void* answer);
  void tellIfCurrent(vtkObject* caller, unsigned long event, void* answer);
  void tellSupported(vtkObject* caller, unsigned long event, void* answer);
  void render();

  std::unique_ptr<EglContext> egl_;
  vtkNew<EglTolerantWindow> window_;
  QImage image_;
  bool stale_ = true;
};

}  // namespace gyre
