// What a command says of a surface it has made.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "app/cli/console.h"
#include "core/pipeline/make_mesh.h"
#include "core/scan/clean_report.h"
#include "core/scan/mesh_health.h"

namespace gyre {

// The method, what each step of the clean-up did, whether the mesh can be printed and how large it
// is, how much of it no camera saw, and how far it was moved to stand on the bed. health: the
// mesh's.
void tellMesh(Console& console, const MadeMesh& made, const MeshHealth& health,
              const std::optional<CleanReport>& cleaned, double moved_mm);

}  // namespace gyre
