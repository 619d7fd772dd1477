// Shows the turntable, its axis and the camera around it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include <vtkNew.h>

#include "core/scan/calibration.h"
#include "core/scan/point_cloud.h"
#include "core/scan/usable_cylinder.h"

class vtkActor;
class vtkRenderer;

namespace gyre {

// Drawn in the table frame: the object rests, and the camera is what goes round. GUI thread only.
class RigActors {
 public:
  explicit RigActors(vtkRenderer& renderer);
  ~RigActors();

  // Places the camera where it is at table angle 0; hides it when the calibration has no pose.
  void showCamera(const Calibration& calibration);
  // Where an object stays in the picture: rims and upright lines; nothing hides it.
  void showUsable(const std::optional<UsableCylinder>& cylinder);
  void setTableAngleRad(double angle_rad);
  // What the drawn camera fills now; empty while it is hidden. [mm]
  Bounds cameraBounds() const;
  // RGB in [0, 1]. Lines are drawn opaque: some software renderers blend lines wrongly.
  void setColours(const std::array<double, 3>& platter, const std::array<double, 3>& grid);

  static constexpr double kPlatterRadius_mm = 90.0;

 private:
  vtkNew<vtkActor> platter_;
  vtkNew<vtkActor> grid_;
  vtkNew<vtkActor> axis_;
  vtkNew<vtkActor> usable_;
  vtkNew<vtkActor> camera_;
  vtkNew<vtkActor> sight_;  // the optical axis, from the camera to the height of the table's
};

}  // namespace gyre
