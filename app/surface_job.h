// Makes the surface that the window asks for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/alpha_shape.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"
#include "core/scan/mesh_method.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct SurfaceWish {
  MeshMethod method = MeshMethod::kAuto;
  double gap_size_mm = 0.0;  // of alpha shapes; 0: chosen by the program
};

struct MadeSurface {
  MeshPtr mesh;
  MeshHealth health;
  // The cloud's triangulation, where one was made or given: with it the next alpha shape follows a
  // slider.
  std::shared_ptr<const AlphaShape> alpha_shape;
};

// folder: where calibration, angles and outlines of the cloud lie; may be empty. alpha_shape: of
// this cloud, or null. Any thread.
Result<MadeSurface> makeSurface(const PointCloud& cloud, const std::filesystem::path& folder,
                                const SurfaceWish& wish,
                                std::shared_ptr<const AlphaShape> alpha_shape, const Task& task);

}  // namespace gyre
