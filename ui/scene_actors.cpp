// Everything that stands in the 3D scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_actors.h"

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include "ui/scene_camera.h"

namespace gyre {
namespace {

vtkSmartPointer<vtkPolyData> shapeOf(const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkUnsignedCharArray> colours;
  normals->SetNumberOfComponents(3);
  colours->SetNumberOfComponents(3);
  const auto count = static_cast<vtkIdType>(mesh.vertices.size());
  points->SetNumberOfPoints(count);
  normals->SetNumberOfTuples(count);
  colours->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const MeshVertex& vertex = mesh.vertices[static_cast<std::size_t>(i)];
    points->SetPoint(i, vertex.position.data());
    normals->SetTuple(i, vertex.normal.data());
    colours->SetTypedTuple(i, vertex.rgb.data());
  }
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(mesh.triangles.size()),
                       3 * static_cast<vtkIdType>(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetPolys(cells);
  shape->GetPointData()->SetNormals(normals);
  shape->GetPointData()->SetScalars(colours);
  return shape;
}

}  // namespace

SceneActors::SceneActors() : cloud_(*renderer_), rig_(*renderer_), target_(*renderer_) {
  vtkNew<vtkPolyDataMapper> mapper;
  mesh_->SetMapper(mapper);
  // As with the cloud: a speck under the platter has the programs for meshes compiled early.
  Mesh under_platter;
  under_platter.vertices.resize(3);
  for (MeshVertex& vertex : under_platter.vertices) {
    vertex.position.z() = -0.6;
    vertex.normal.z() = 1.0;
  }
  under_platter.vertices[1].position.x() = 0.01;
  under_platter.vertices[2].position.y() = 0.01;
  under_platter.triangles.push_back({0, 1, 2});
  mapper->SetInputData(shapeOf(under_platter));
  mesh_->GetProperty()->SetInterpolationToPhong();
  mesh_->GetProperty()->SetAmbient(0.35);
  mesh_->GetProperty()->SetDiffuse(0.75);
  renderer_->AddActor(mesh_);
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
    rig_.setLineColour({0.70, 0.76, 0.82});
  } else {
    renderer_->SetBackground(0.865, 0.885, 0.905);
    renderer_->SetBackground2(0.965, 0.972, 0.980);
    rig_.setLineColour({0.30, 0.36, 0.43});
  }
  const double text = dark ? 0.85 : 0.25;
  auto* axes = vtkAxesActor::SafeDownCast(corner_renderer_->GetViewProps()->GetItemAsObject(0));
  for (vtkCaptionActor2D* caption : {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(),
                                     axes->GetZAxisCaptionActor2D()}) {
    caption->GetCaptionTextProperty()->SetColor(text, text, text);
  }
}

void SceneActors::showMesh(const MeshPtr& mesh) {
  mesh_->SetVisibility(mesh ? 1 : 0);
  mesh_bounds_ = mesh ? boundsOf(*mesh) : Bounds{};
  cloud_.setVisible(mesh ? CloudVisibility::kHidden : CloudVisibility::kShown);
  if (!mesh) return;
  vtkPolyDataMapper::SafeDownCast(mesh_->GetMapper())->SetInputData(shapeOf(*mesh));
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
  Bounds bounds = mesh_bounds_.empty() ? cloud_.bounds() : mesh_bounds_;
  if (!bounds.empty()) return bounds;
  bounds.include({-kRadius, -kRadius, 0.0});
  bounds.include({kRadius, kRadius, 0.6 * kRadius});
  return bounds;
}

}  // namespace gyre
