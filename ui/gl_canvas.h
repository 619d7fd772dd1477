// Draws the 3D scene with the OpenGL that Qt shows.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QOpenGLWidget>

#include <vtkNew.h>

#include "ui/egl_tolerant_window.h"
#include "ui/scene_canvas.h"

namespace gyre {

// Debian's VTK is built for Qt 5 widgets, so this hosts VTK's generic window in Qt 6's widget.
class GlCanvas final : public QOpenGLWidget, public SceneCanvas {
  Q_OBJECT

 public:
  explicit GlCanvas(QWidget* parent = nullptr);
  ~GlCanvas() override;

  QWidget* widget() override { return this; }
  vtkRenderWindow* window() override { return window_; }
  void requestRender() override { update(); }
  QImage picture() override { return grabFramebuffer(); }
  bool rendersInSoftware() override { return window_->rendersInSoftware(); }

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;

 private:
  void makeVtkCurrent(vtkObject* caller, unsigned long event, void* answer);
  void tellIfCurrent(vtkObject* caller, unsigned long event, void* answer);
  void tellSupported(vtkObject* caller, unsigned long event, void* answer);
  void releaseGl();

  vtkNew<EglTolerantWindow> window_;
};

}  // namespace gyre
