// Everything that stands in the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkNew.h>

#include "core/scan/calibration.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"
#include "ui/cloud_actors.h"
#include "ui/rig_actors.h"
#include "ui/target_actor.h"

class vtkActor;
class vtkRenderer;
class vtkRenderWindow;

namespace gyre {

class SceneCamera;

enum class SceneTheme { kLight, kDark };

// Not a widget: knows renderers and actors only. GUI thread only.
class SceneActors {
 public:
  SceneActors();
  ~SceneActors();

  void addTo(vtkRenderWindow& window);
  void lookThrough(const SceneCamera& camera);
  void setTheme(SceneTheme theme);

  CloudActors& cloud() { return cloud_; }
  const CloudActors& cloud() const { return cloud_; }
  RigActors& rig() { return rig_; }
  TargetActor& target() { return target_; }

  // Shows the mesh in place of the cloud; null shows the cloud again.
  void showMesh(const MeshPtr& mesh);

  // What the object fills; the platter while there is nothing of it. [mm]
  Bounds objectBounds() const;
  // The same with the platter and, where it is known, the camera. [mm]
  Bounds rigBounds() const;

 private:
  void buildCornerAxes();

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderer> corner_renderer_;
  vtkNew<vtkActor> mesh_;
  CloudActors cloud_;
  RigActors rig_;
  TargetActor target_;
  Bounds mesh_bounds_;
};

}  // namespace gyre
