// Everything that stands in the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_actors.h"

#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellPicker.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "ui/scene_camera.h"

namespace gyre {
SceneActors::SceneActors()
    : mesh_(*renderer_),
      cloud_(*renderer_),
      rig_(*renderer_),
      target_(*renderer_),
      crop_(*renderer_) {
  renderer_->GradientBackgroundOn();
  buildCornerAxes();
  setTheme(SceneTheme::kLight);
}

SceneActors::~SceneActors() = default;

void SceneActors::buildCornerAxes() {
  vtkNew<vtkAxesActor> axes;
  axes->SetShaftTypeToCylinder();
  axes->SetCylinderRadius(0.04);
  axes->SetConeRadius(0.22);
  for (vtkCaptionActor2D* caption : {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(),
                                     axes->GetZAxisCaptionActor2D()}) {
    caption->GetTextActor()->SetTextScaleModeToNone();
    caption->GetCaptionTextProperty()->SetFontSize(12);
    caption->GetCaptionTextProperty()->ShadowOff();
    caption->GetCaptionTextProperty()->ItalicOff();
    caption->GetCaptionTextProperty()->BoldOff();
  }
  corner_renderer_->AddActor(axes);
  corner_renderer_->SetLayer(1);
  corner_renderer_->InteractiveOff();
  corner_renderer_->SetViewport(0.0, 0.0, 0.16, 0.20);
}

void SceneActors::addTo(vtkRenderWindow& window) {
  window.SetNumberOfLayers(2);
  window.AddRenderer(renderer_);
  window.AddRenderer(corner_renderer_);
}

void SceneActors::lookThrough(const SceneCamera& camera) {
  camera.applyTo(*renderer_->GetActiveCamera());
  renderer_->ResetCameraClippingRange();
  // The corner shows the same directions from a fixed distance.
  constexpr double kCornerDistance = 5.0;
  vtkCamera* from = renderer_->GetActiveCamera();
  vtkCamera* corner = corner_renderer_->GetActiveCamera();
  const Eigen::Vector3d focus(from->GetFocalPoint());
  const Eigen::Vector3d eye =
      kCornerDistance * (Eigen::Vector3d(from->GetPosition()) - focus).normalized();
  corner->SetFocalPoint(0.0, 0.0, 0.0);
  corner->SetPosition(eye.data());
  corner->SetViewUp(0.0, 0.0, 1.0);
  corner_renderer_->ResetCameraClippingRange();
}

void SceneActors::setTheme(SceneTheme theme) {
  const bool dark = theme == SceneTheme::kDark;
  if (dark) {
    renderer_->SetBackground(0.075, 0.090, 0.110);
    renderer_->SetBackground2(0.150, 0.175, 0.205);
    rig_.setColours({0.70, 0.76, 0.82}, {0.26, 0.29, 0.33});
  } else {
    renderer_->SetBackground(0.865, 0.885, 0.905);
    renderer_->SetBackground2(0.965, 0.972, 0.980);
    rig_.setColours({0.30, 0.36, 0.43}, {0.77, 0.79, 0.82});
  }
  const double text = dark ? 0.85 : 0.25;
  auto* axes = vtkAxesActor::SafeDownCast(corner_renderer_->GetViewProps()->GetItemAsObject(0));
  for (vtkCaptionActor2D* caption : {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(),
                                     axes->GetZAxisCaptionActor2D()}) {
    caption->GetCaptionTextProperty()->SetColor(text, text, text);
  }
}

void SceneActors::showMesh(const MeshPtr& mesh) {
  mesh_.show(mesh);
  cloud_.setVisible(mesh ? CloudVisibility::kHidden : CloudVisibility::kShown);
}

std::optional<ScenePick> SceneActors::pick(const Eigen::Vector2d& at_px) {
  if (!mesh_.shows()) return cloud_.pick(*renderer_, at_px);
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0.0);
  picker->PickFromListOn();
  picker->AddPickList(mesh_.surface());
  if (picker->Pick(at_px.x(), at_px.y(), 0.0, renderer_) == 0) return std::nullopt;
  return ScenePick{ScenePick::On::kTriangle, static_cast<std::size_t>(picker->GetCellId()),
                   Eigen::Vector3d(picker->GetPickPosition())};
}

Bounds SceneActors::rigBounds() const {
  Bounds bounds = objectBounds();
  constexpr double kRadius = RigActors::kPlatterRadius_mm;
  bounds.include({-kRadius, -kRadius, 0.0});
  bounds.include({kRadius, kRadius, 0.0});
  if (const Bounds camera = rig_.cameraBounds(); !camera.empty()) {
    bounds.include(camera.min);
    bounds.include(camera.max);
  }
  return bounds;
}

Bounds SceneActors::objectBounds() const {
  constexpr double kRadius = RigActors::kPlatterRadius_mm;
  Bounds bounds = mesh_.shows() ? mesh_.bounds() : cloud_.bounds();
  if (!bounds.empty()) return bounds;
  bounds.include({-kRadius, -kRadius, 0.0});
  bounds.include({kRadius, kRadius, 0.6 * kRadius});
  return bounds;
}

}  // namespace gyre
