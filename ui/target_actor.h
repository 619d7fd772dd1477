// Shows a calibration target where it stands on the table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkNew.h>

#include "core/scan/calibration.h"
#include "core/scan/target.h"

class vtkActor;
class vtkRenderer;

namespace gyre {

// Its corners as dots and its markers as squares, in the table frame. GUI thread only.
class TargetActor {
 public:
  explicit TargetActor(vtkRenderer& renderer);
  ~TargetActor();

  void show(const Target& target, const Rigid3& table_from_target);
  void hide();

 private:
  vtkNew<vtkActor> corners_;
  vtkNew<vtkActor> markers_;
};

}  // namespace gyre
