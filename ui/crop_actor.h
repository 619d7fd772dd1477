// Shows where a crop cuts: the cylinder about the axis and the planes below and above.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkNew.h>

#include "core/mesh/clean/options.h"
#include "core/scan/point_cloud.h"

class vtkActor;
class vtkRenderer;

namespace gyre {

// Not a widget: fills a renderer. GUI thread only.
class CropActor {
 public:
  explicit CropActor(vtkRenderer& renderer);
  ~CropActor();

  // around: what is cropped, so that planes are as large and the cylinder as high. Limits at which
  // nothing is cut off are not drawn.
  void show(const CropOptions& crop, const Bounds& around);

 private:
  vtkNew<vtkActor> walls_;
  vtkNew<vtkActor> edges_;
};

}  // namespace gyre
