// Shows a surface, and hatches what no camera saw of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include <vtkNew.h>

#include "core/scan/mesh.h"

class vtkActor;
class vtkRenderer;

namespace gyre {

enum class Hatching { kShown, kHidden };

// Triangles with a corner that no camera saw get stripes, whatever their colour. Not a widget:
// fills a renderer. GUI thread only.
class MeshActor {
 public:
  explicit MeshActor(vtkRenderer& renderer);
  ~MeshActor();

  void show(const MeshPtr& mesh);  // null: nothing
  void setHatching(Hatching hatching);
  // Device pixels for one pixel of the design: the stripes are as wide on every screen.
  void setPixelRatio(double ratio);

  bool shows() const { return !bounds_.empty(); }
  Bounds bounds() const { return bounds_; }
  bool hatches() const { return hatching_ == Hatching::kShown && unseen_triangles_ > 0; }

  // For picking: the cells of this actor are the mesh's triangles, in their order.
  vtkActor* surface() { return surface_; }

 private:
  void fill(const Mesh& mesh);
  void showHatch();

  vtkNew<vtkActor> surface_;
  vtkNew<vtkActor> hatch_;
  Bounds bounds_;
  Hatching hatching_ = Hatching::kShown;
  std::size_t unseen_triangles_ = 0;
};

}  // namespace gyre
