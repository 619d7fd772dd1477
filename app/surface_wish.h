// What kind of surface the user asks for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/mesh_method.h"

namespace gyre {

struct SurfaceWish {
  MeshMethod method = MeshMethod::kAuto;
  double gap_size_mm = 0.0;  // of alpha shapes; 0: chosen by the program
};

}  // namespace gyre
