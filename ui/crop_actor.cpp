// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/crop_actor.h"

#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kCorners = 96;
constexpr int kPosts = 12;
constexpr double kMargin = 1.15;  // of planes over what they cut

// Collects the walls that are seen through, and the lines around them.
class CropShape {
 public:
  // From one height to another; a ring where they are the same.
  void addCylinder(double radius_mm, double low_mm, double high_mm) {
    for (int i = 0; i < kCorners; ++i) {
      const vtkIdType corners[] = {corner(i, radius_mm, low_mm), corner(i + 1, radius_mm, low_mm),
                                   corner(i + 1, radius_mm, high_mm),
                                   corner(i, radius_mm, high_mm)};
      walls_->InsertNextCell(4, corners);
      addEdge(corners[0], corners[1]);
      addEdge(corners[2], corners[3]);
      if (i % (kCorners / kPosts) == 0) addEdge(corners[0], corners[3]);
    }
  }
  void addDisc(double radius_mm, double height_mm) {
    walls_->InsertNextCell(kCorners);
    for (int i = 0; i < kCorners; ++i) walls_->InsertCellPoint(corner(i, radius_mm, height_mm));
    for (int i = 0; i < kCorners; ++i) {
      addEdge(corner(i, radius_mm, height_mm), corner(i + 1, radius_mm, height_mm));
    }
  }
  void giveTo(vtkActor& walls, vtkActor& edges) const {
    vtkNew<vtkPolyData> wall_shape;
    wall_shape->SetPoints(points_);
    wall_shape->SetPolys(walls_);
    vtkPolyDataMapper::SafeDownCast(walls.GetMapper())->SetInputData(wall_shape);
    vtkNew<vtkPolyData> edge_shape;
    edge_shape->SetPoints(points_);
    edge_shape->SetLines(edges_);
    vtkPolyDataMapper::SafeDownCast(edges.GetMapper())->SetInputData(edge_shape);
  }

 private:
  vtkIdType corner(int number, double radius_mm, double height_mm) {
    const double angle_rad = kTurn_rad * number / kCorners;
    return points_->InsertNextPoint(radius_mm * std::cos(angle_rad),
                                    radius_mm * std::sin(angle_rad), height_mm);
  }
  void addEdge(vtkIdType from, vtkIdType to) { edges_->InsertNextCell({from, to}); }

  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> walls_;
  vtkNew<vtkCellArray> edges_;
};

}  // namespace

CropActor::CropActor(vtkRenderer& renderer) {
  for (vtkActor* actor : {walls_.Get(), edges_.Get()}) {
    vtkNew<vtkPolyDataMapper> mapper;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(0.92, 0.36, 0.12);
    actor->PickableOff();
    actor->VisibilityOff();
    renderer.AddActor(actor);
  }
  walls_->GetProperty()->SetOpacity(0.10);
}

CropActor::~CropActor() = default;

void CropActor::show(const CropOptions& crop, const Bounds& around) {
  const bool has_floor = crop.z_min_mm > -kNoCrop_mm;
  const bool has_roof = crop.z_max_mm < kNoCrop_mm;
  const bool any = !around.empty() && (crop.radius_mm > 0.0 || has_floor || has_roof);
  walls_->SetVisibility(any ? 1 : 0);
  edges_->SetVisibility(any ? 1 : 0);
  if (!any) return;
  const double reach_mm = std::hypot(std::max(std::abs(around.min.x()), std::abs(around.max.x())),
                                     std::max(std::abs(around.min.y()), std::abs(around.max.y())));
  const double radius_mm = crop.radius_mm > 0.0 ? crop.radius_mm : kMargin * reach_mm;
  const double floor_mm = has_floor ? crop.z_min_mm : around.min.z();
  const double roof_mm = has_roof ? crop.z_max_mm : around.max.z();
  CropShape shape;
  if (crop.radius_mm > 0.0) shape.addCylinder(radius_mm, floor_mm, roof_mm);
  if (has_floor) shape.addDisc(radius_mm, floor_mm);
  if (has_roof) shape.addDisc(radius_mm, roof_mm);
  shape.giveTo(*walls_, *edges_);
}

}  // namespace gyre
