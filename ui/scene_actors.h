// Everything that stands in the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <vtkNew.h>

#include "core/scan/calibration.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"
#include "ui/cloud_actors.h"
#include "ui/crop_actor.h"
#include "ui/mesh_actor.h"
#include "ui/rig_actors.h"
#include "ui/scene_pick.h"
#include "ui/target_actor.h"

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
  MeshActor& mesh() { return mesh_; }
  CropActor& crop() { return crop_; }

  // Shows the mesh in place of the cloud; null shows the cloud again.
  void showMesh(const MeshPtr& mesh);

  // What is seen at a pixel of the window (device pixels, y up): of the mesh, or of the cloud while
  // that is shown. Nothing beside the object.
  std::optional<ScenePick> pick(const Eigen::Vector2d& at_px);

  // What the object fills; the platter while there is nothing of it. [mm]
  Bounds objectBounds() const;
  // The same with the platter and, where it is known, the camera. [mm]
  Bounds rigBounds() const;

 private:
  void buildCornerAxes();

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderer> corner_renderer_;
  MeshActor mesh_;
  CloudActors cloud_;
  RigActors rig_;
  TargetActor target_;
  CropActor crop_;
};

}  // namespace gyre
