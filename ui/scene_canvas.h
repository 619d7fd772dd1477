// The surface on which the 3D scene is drawn, whatever draws it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QWidget>

class vtkRenderWindow;

namespace gyre {

// Two kinds: GlCanvas where Qt can show OpenGL, ImageCanvas where it cannot. GUI thread only.
class SceneCanvas {
 public:
  virtual ~SceneCanvas() = default;

  virtual QWidget* widget() = 0;
  virtual vtkRenderWindow* window() = 0;

  // Draws again soon; many requests are one drawing.
  virtual void requestRender() = 0;

  // Draws now and gives what is seen, in device pixels.
  virtual QImage picture() = 0;

  // True when the processor draws: big clouds are then thinned while the view moves.
  virtual bool rendersInSoftware() = 0;

 protected:
  SceneCanvas() = default;
  SceneCanvas(const SceneCanvas&) = default;
  SceneCanvas& operator=(const SceneCanvas&) = default;
};

// The kind that works on this screen, owned by the parent; null when neither does.
SceneCanvas* makeSceneCanvas(QWidget* parent);

// What an OpenGL context of this program must be. Set as QSurfaceFormat's default before the
// application object is made.
void setDefaultSurfaceFormat();

}  // namespace gyre
