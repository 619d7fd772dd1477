// Draws the 3D scene with the OpenGL that Qt shows.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/gl_canvas.h"

#include <QOpenGLContext>

#include <vtkCommand.h>
#include <vtkOpenGLState.h>

namespace gyre {

GlCanvas::GlCanvas(QWidget* parent) : QOpenGLWidget(parent) {
  window_->SetOwnContext(0);
  window_->SetMultiSamples(0);
  window_->SetReadyForRendering(false);
  window_->SetFrameBlitModeToBlitToCurrent();
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, this, &GlCanvas::makeVtkCurrent);
  window_->AddObserver(vtkCommand::WindowIsCurrentEvent, this, &GlCanvas::tellIfCurrent);
  window_->AddObserver(vtkCommand::WindowSupportsOpenGLEvent, this, &GlCanvas::tellSupported);
}

GlCanvas::~GlCanvas() {
  // ~QOpenGLWidget announces the end of the context when our members are gone.
  if (context() != nullptr) disconnect(context(), nullptr, this, nullptr);
  releaseGl();
}

// Not QOpenGLWidget::makeCurrent(): that binds the widget's frame buffer as well, and VTK asks in
// the middle of its drawing, which would then go to the wrong buffer without any error.
void GlCanvas::makeVtkCurrent(vtkObject*, unsigned long, void*) {
  if (context() != nullptr) context()->makeCurrent(context()->surface());
}

void GlCanvas::tellIfCurrent(vtkObject*, unsigned long, void* answer) {
  *static_cast<bool*>(answer) =
      context() != nullptr && QOpenGLContext::currentContext() == context();
}

void GlCanvas::tellSupported(vtkObject*, unsigned long, void* answer) {
  *static_cast<int*>(answer) = 1;
}

void GlCanvas::initializeGL() {
  // Docking and reparenting make a new context.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlCanvas::releaseGl,
          Qt::UniqueConnection);
  window_->SetForceMaximumHardwareLineWidth(1.0F);
  window_->SetReadyForRendering(true);
  window_->InitializeFromCurrentContext();
}

void GlCanvas::resizeGL(int width, int height) {
  const double ratio = devicePixelRatioF();
  window_->SetDPI(static_cast<int>(72.0 * ratio));
  window_->SetSize(qRound(width * ratio), qRound(height * ratio));
}

void GlCanvas::paintGL() {
  vtkOpenGLState* state = window_->GetState();
  state->Reset();  // Qt has changed what VTK believes of the context
  state->Push();
  state->vtkglDepthFunc(GL_LEQUAL);
  window_->Render();
  state->Pop();
}

void GlCanvas::releaseGl() {
  if (context() == nullptr) return;
  makeCurrent();
  window_->Finalize();
  window_->SetReadyForRendering(false);
  doneCurrent();
}

}  // namespace gyre
