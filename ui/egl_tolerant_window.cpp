// A VTK window for a foreign GL context that also accepts contexts made by EGL.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/egl_tolerant_window.h"

#include <vtk_glew.h>

#include <string_view>

#include <vtkObjectFactory.h>

namespace gyre {

vtkStandardNewMacro(EglTolerantWindow)

    void EglTolerantWindow::OpenGLInitContext() {
  if (!Initialized) {
    constexpr GLenum kNoGlxDisplay = 4;  // GLEW_ERROR_NO_GLX_DISPLAY
    const GLenum outcome = glewInit();
    if (outcome == GLEW_OK || outcome == kNoGlxDisplay) {
      GlewInitValid = true;
      Initialized = true;
      float widths[2] = {1.0F, 1.0F};
      glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, widths);
      MaximumHardwareLineWidth = widths[1];
    }
  }
  Superclass::OpenGLInitContext();  // reports what is wrong when the above failed
}

bool EglTolerantWindow::rendersInSoftware() {
  if (!Initialized) return false;
  const std::string_view report = ReportCapabilities();
  return report.find("llvmpipe") != std::string_view::npos ||
         report.find("softpipe") != std::string_view::npos;
}

}  // namespace gyre
