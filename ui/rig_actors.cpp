// Shows the turntable, its axis and the camera around it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/rig_actors.h"

#include <array>
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

// Collects line segments and makes an actor of them.
class Lines {
 public:
  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    cells_->InsertNextCell(2);
    cells_->InsertCellPoint(points_->InsertNextPoint(from.data()));
    cells_->InsertCellPoint(points_->InsertNextPoint(to.data()));
  }
  void giveTo(vtkActor& actor) const {
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(points_);
    shape->SetLines(cells_);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(shape);
    actor.SetMapper(mapper);
    actor.GetProperty()->LightingOff();
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
};

constexpr int kRimCorners = 96;
constexpr double kGridStep_mm = 10.0;
// The disc lies a little below the grid, and the grid below what stands on the table.
constexpr double kDiscHeight_mm = -0.6;
constexpr double kGridHeight_mm = -0.3;

Eigen::Vector3d rimPoint(int corner, double radius_mm, double height_mm) {
  const double angle_rad = kTurn_rad * corner / kRimCorners;
  return {radius_mm * std::cos(angle_rad), radius_mm * std::sin(angle_rad), height_mm};
}

void buildDisc(vtkActor& actor) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(kRimCorners);
  for (int i = 0; i < kRimCorners; ++i) {
    const Eigen::Vector3d corner = rimPoint(i, RigActors::kPlatterRadius_mm, kDiscHeight_mm);
    cells->InsertCellPoint(points->InsertNextPoint(corner.data()));
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  actor.SetMapper(mapper);
  actor.GetProperty()->LightingOff();
  actor.GetProperty()->SetOpacity(0.12);
}

void buildGrid(vtkActor& actor) {
  constexpr double kRadius = RigActors::kPlatterRadius_mm;
  Lines lines;
  for (double at = -kRadius + kGridStep_mm; at < kRadius; at += kGridStep_mm) {
    const double half = std::sqrt(kRadius * kRadius - at * at);
    lines.add({at, -half, kGridHeight_mm}, {at, half, kGridHeight_mm});
    lines.add({-half, at, kGridHeight_mm}, {half, at, kGridHeight_mm});
  }
  for (int i = 0; i < kRimCorners; ++i) {
    lines.add(rimPoint(i, kRadius, kGridHeight_mm), rimPoint(i + 1, kRadius, kGridHeight_mm));
  }
  lines.giveTo(actor);
}

void buildAxis(vtkActor& actor) {
  constexpr double kLength_mm = 110.0;
  constexpr double kDash_mm = 4.0;
  Lines lines;
  for (double z = 0.0; z < kLength_mm; z += 2.0 * kDash_mm) {
    lines.add({0, 0, z}, {0, 0, z + kDash_mm});
  }
  lines.giveTo(actor);
  actor.GetProperty()->SetColor(0.16, 0.62, 0.66);
}

}  // namespace

RigActors::RigActors(vtkRenderer& renderer) {
  buildDisc(*platter_);
  buildGrid(*grid_);
  buildAxis(*axis_);
  usable_->VisibilityOff();
  camera_->VisibilityOff();
  sight_->VisibilityOff();
  for (vtkActor* actor :
       {platter_.Get(), grid_.Get(), axis_.Get(), usable_.Get(), camera_.Get(), sight_.Get()}) {
    actor->PickableOff();
    renderer.AddActor(actor);
  }
  setColours({0.35, 0.40, 0.46}, {0.78, 0.80, 0.83});
}

RigActors::~RigActors() = default;

void RigActors::showCamera(const Calibration& calibration) {
  for (vtkActor* actor : {camera_.Get(), sight_.Get()}) {
    actor->SetVisibility(calibration.cam_from_table.has_value() ? 1 : 0);
  }
  if (!calibration.cam_from_table) return;
  const Rigid3 table_from_cam = calibration.cam_from_table->inverse();
  const CameraModel& model = calibration.camera;
  const double distance_mm = table_from_cam.translation.norm();
  const auto at = [&](double u, double v, double depth_mm) -> Eigen::Vector3d {
    const Eigen::Vector3d in_cam((u - model.cx) / model.fx, (v - model.cy) / model.fy, 1.0);
    return table_from_cam * Eigen::Vector3d(depth_mm * in_cam);
  };
  const double width = model.width_px;
  const double height = model.height_px;
  const std::array<Eigen::Vector2d, 4> pixels = {
      {{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}};
  std::array<Eigen::Vector3d, 4> corners;
  Lines lines;
  Lines sight;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = at(pixels[i].x(), pixels[i].y(), 0.2 * distance_mm);
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    lines.add(table_from_cam.translation, corners[i]);
    lines.add(corners[i], corners[(i + 1) % corners.size()]);
  }
  sight.add(at(model.cx, model.cy, 0.2 * distance_mm), at(model.cx, model.cy, distance_mm));
  const Eigen::Vector3d tip = at(0.5 * width, -0.25 * height, 0.2 * distance_mm);  // upwards
  lines.add(corners[0], tip);
  lines.add(tip, corners[1]);
  lines.giveTo(*camera_);
  sight.giveTo(*sight_);
  camera_->GetProperty()->SetColor(0.90, 0.55, 0.18);
  sight_->GetProperty()->SetColor(0.88, 0.68, 0.44);
  camera_->GetProperty()->SetLineWidth(2.0F);
}

void RigActors::showUsable(const std::optional<UsableCylinder>& cylinder) {
  usable_->SetVisibility(cylinder.has_value() ? 1 : 0);
  if (!cylinder) return;
  constexpr int kUprightEvery = kRimCorners / 12;
  Lines lines;
  for (int i = 0; i < kRimCorners; ++i) {
    for (const double height_mm : {0.0, cylinder->height_mm}) {
      lines.add(rimPoint(i, cylinder->radius_mm, height_mm),
                rimPoint(i + 1, cylinder->radius_mm, height_mm));
    }
    if (i % kUprightEvery == 0) {
      lines.add(rimPoint(i, cylinder->radius_mm, 0.0),
                rimPoint(i, cylinder->radius_mm, cylinder->height_mm));
    }
  }
  lines.giveTo(*usable_);
  usable_->GetProperty()->SetColor(0.20, 0.62, 0.90);
}

void RigActors::setTableAngleRad(double angle_rad) {
  // x_in_table = Rz(-angle) x_in_base: seen from the table, the camera goes the other way.
  camera_->SetOrientation(0.0, 0.0, -degFromRad(angle_rad));
  sight_->SetOrientation(0.0, 0.0, -degFromRad(angle_rad));
}

Bounds RigActors::cameraBounds() const {
  Bounds bounds;
  if (camera_->GetVisibility() == 0) return bounds;
  const double* drawn = camera_->GetBounds();  // x from, x to, y from, ...; turned as it is shown
  bounds.include({drawn[0], drawn[2], drawn[4]});
  bounds.include({drawn[1], drawn[3], drawn[5]});
  return bounds;
}

void RigActors::setColours(const std::array<double, 3>& platter,
                           const std::array<double, 3>& grid) {
  platter_->GetProperty()->SetColor(platter[0], platter[1], platter[2]);
  grid_->GetProperty()->SetColor(grid[0], grid[1], grid[2]);
}

}  // namespace gyre
