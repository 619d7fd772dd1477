// Draws the 3D scene without any screen and shows it as a picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/image_canvas.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <QPainter>

#include <vtkCommand.h>
#include <vtkUnsignedCharArray.h>

namespace gyre {

// An OpenGL 3.2 context that needs no surface.
class ImageCanvas::EglContext {
 public:
  EglContext() {
    const auto platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (platform_display == nullptr) return;
    display_ = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
      return;
    eglBindAPI(EGL_OPENGL_API);
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 2,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  }
  ~EglContext() {
    if (context_ == EGL_NO_CONTEXT) return;
    release();
    eglDestroyContext(display_, context_);  // the display is shared by all canvases: it stays
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  bool works() const { return context_ != EGL_NO_CONTEXT; }
  bool current() const { return works() && eglGetCurrentContext() == context_; }
  void makeCurrent() {
    eglBindAPI(EGL_OPENGL_API);
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }
  void release() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

ImageCanvas::ImageCanvas(QWidget* parent) : QWidget(parent), egl_(std::make_unique<EglContext>()) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, this, &ImageCanvas::makeVtkCurrent);
  window_->AddObserver(vtkCommand::WindowIsCurrentEvent, this, &ImageCanvas::tellIfCurrent);
  window_->AddObserver(vtkCommand::WindowSupportsOpenGLEvent, this, &ImageCanvas::tellSupported);
  window_->SetOwnContext(0);
  window_->SetMultiSamples(0);
  window_->SetShowWindow(false);
  window_->SetUseOffScreenBuffers(true);
  window_->SetFrameBlitModeToNoBlit();
  if (!works()) return;
  egl_->makeCurrent();
  window_->InitializeFromCurrentContext();
  egl_->release();
}

ImageCanvas::~ImageCanvas() {
  if (!works()) return;
  egl_->makeCurrent();
  window_->Finalize();
  egl_->release();
}

bool ImageCanvas::works() const { return egl_->works(); }

void ImageCanvas::makeVtkCurrent(vtkObject*, unsigned long, void*) { egl_->makeCurrent(); }

void ImageCanvas::tellIfCurrent(vtkObject*, unsigned long, void* answer) {
  *static_cast<bool*>(answer) = egl_->current();
}

void ImageCanvas::tellSupported(vtkObject*, unsigned long, void* answer) {
  *static_cast<int*>(answer) = 1;
}

void ImageCanvas::requestRender() {
  stale_ = true;
  update();
}

QImage ImageCanvas::picture() {
  render();
  return image_;
}

void ImageCanvas::render() {
  const QSize size = this->size() * devicePixelRatioF();
  if (size.isEmpty()) return;
  egl_->makeCurrent();
  window_->SetDPI(static_cast<int>(72.0 * devicePixelRatioF()));
  window_->SetSize(size.width(), size.height());
  window_->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window_->GetRGBACharPixelData(0, 0, size.width() - 1, size.height() - 1, 0, pixels);
  egl_->release();
  const QImage upside_down(pixels->GetPointer(0), size.width(), size.height(),
                           QImage::Format_RGBX8888);
  image_ = upside_down.mirrored().convertToFormat(QImage::Format_RGB32);
  image_.setDevicePixelRatio(devicePixelRatioF());
  stale_ = false;
}

void ImageCanvas::paintEvent(QPaintEvent*) {
  if (stale_) render();
  QPainter painter(this);
  painter.drawImage(0, 0, image_);
}

void ImageCanvas::resizeEvent(QResizeEvent*) { stale_ = true; }

}  // namespace gyre
