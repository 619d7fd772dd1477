// Makes a surface of a cloud by the method that was chosen.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/mesh/options.h"
#include "core/mesh/sight_evidence.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_method.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct MeshRequest {
  MeshMethod method = MeshMethod::kAuto;
  AlphaShapeOptions alpha;
  VisibilityCutOptions cut;
  VisualHullOptions hull;
  PoissonOptions poisson;
  WrapOptions wrap;
};

struct MadeMesh {
  Mesh mesh;
  MeshMethod method = MeshMethod::kAuto;  // as used
  double alpha_mm = 0.0;                  // of alpha shapes and wraps
};

// kAuto takes the visibility cut where sights are known, else the alpha shape; kWatertight wraps
// what kAuto makes; kSilhouette needs no points, and takes colours from them where there are any.
// Fails as the method does, and when it needs sights that are not known.
Result<MadeMesh> makeMesh(const PointCloud& cloud, const std::optional<SightEvidence>& sights,
                          const MeshRequest& request, const Task& task);

}  // namespace gyre
