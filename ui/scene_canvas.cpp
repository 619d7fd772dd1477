// Chooses the surface on which the 3D scene is drawn.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_canvas.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QSurfaceFormat>

#include "ui/gl_canvas.h"
#include "ui/image_canvas.h"

namespace gyre {
namespace {

// Platforms without windows of their own say that they have OpenGL, and then draw nothing.
bool widgetsCanShowGl() {
  const QString platform = QGuiApplication::platformName();
  if (platform != "xcb" && !platform.startsWith("wayland")) return false;
  QOpenGLContext context;
  QOffscreenSurface surface;
  surface.create();
  return context.create() && context.makeCurrent(&surface);
}

}  // namespace

SceneCanvas* makeSceneCanvas(QWidget* parent) {
  if (widgetsCanShowGl()) return new GlCanvas(parent);
  auto* canvas = new ImageCanvas(parent);
  if (canvas->works()) return canvas;
  delete canvas;
  return nullptr;
}

void setDefaultSurfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
}

}  // namespace gyre
