// What a finished job of the scan controller leaves.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "app/scan_controller.h"

namespace gyre {

struct ScanController::Outcome {
  PointCloudPtr cloud;
  MeshPtr mesh;
  MeshHealth health;
  std::optional<Error> problem;  // shown beside what there is
  std::filesystem::path folder;
};

}  // namespace gyre
