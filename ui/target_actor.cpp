// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/target_actor.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace gyre {
namespace {

void give(vtkActor& actor, vtkPolyData& shape) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&shape);
  actor.SetMapper(mapper);
  actor.GetProperty()->LightingOff();
  actor.VisibilityOn();
}

}  // namespace

TargetActor::TargetActor(vtkRenderer& renderer) {
  for (vtkActor* actor : {corners_.Get(), markers_.Get()}) {
    actor->PickableOff();
    actor->VisibilityOff();
    renderer.AddActor(actor);
  }
  corners_->GetProperty()->SetColor(0.10, 0.45, 0.75);
  corners_->GetProperty()->SetPointSize(5.0F);
  markers_->GetProperty()->SetColor(0.35, 0.40, 0.46);
}

TargetActor::~TargetActor() = default;

void TargetActor::show(const Target& target, const Rigid3& table_from_target) {
  vtkNew<vtkPoints> corner_points;
  vtkNew<vtkCellArray> dots;
  for (const TargetCorner& corner : target.corners) {
    const Eigen::Vector3d in_table = table_from_target * corner.position_in_target;
    dots->InsertNextCell(1);
    dots->InsertCellPoint(corner_points->InsertNextPoint(in_table.data()));
  }
  vtkNew<vtkPolyData> corner_shape;
  corner_shape->SetPoints(corner_points);
  corner_shape->SetVerts(dots);
  give(*corners_, *corner_shape);

  vtkNew<vtkPoints> marker_points;
  vtkNew<vtkCellArray> squares;
  for (const TargetMarker& marker : target.markers) {
    squares->InsertNextCell(static_cast<int>(marker.corners_in_target.size()));
    for (const Eigen::Vector3d& corner : marker.corners_in_target) {
      const Eigen::Vector3d in_table = table_from_target * corner;
      squares->InsertCellPoint(marker_points->InsertNextPoint(in_table.data()));
    }
  }
  vtkNew<vtkPolyData> marker_shape;
  marker_shape->SetPoints(marker_points);
  marker_shape->SetPolys(squares);
  give(*markers_, *marker_shape);
}

void TargetActor::hide() {
  corners_->VisibilityOff();
  markers_->VisibilityOff();
}

}  // namespace gyre
