// A VTK window for a foreign GL context that also accepts contexts made by EGL.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

namespace gyre {

// Debian's GLEW is the GLX build: in an EGL context (Wayland, no X server) glewInit() finds every
// function and still reports that there is no GLX display, on which VTK gives up.
class EglTolerantWindow final : public vtkGenericOpenGLRenderWindow {
 public:
  static EglTolerantWindow* New();
  vtkTypeMacro(EglTolerantWindow, vtkGenericOpenGLRenderWindow)

      void OpenGLInitContext() override;

  // True when the picture is computed by the processor. Known after the first render.
  bool rendersInSoftware();

 private:
  EglTolerantWindow() = default;
};

}  // namespace gyre
