// Makes the surface that the window asks for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/surface_wish.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/alpha_shape.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct MadeSurface {
  MeshPtr mesh;
  MeshHealth health;
  // What people should know of how it was made, in a sentence; empty: as they asked for it.
  std::string remark;
  // The cloud's triangulation, where one was made or given: with it the next alpha shape follows a
  // slider.
  std::shared_ptr<const AlphaShape> alpha_shape;
};

// folder: where calibration, angles and outlines of the cloud lie; may be empty. alpha_shape: of
// this cloud, or null. Fails in the window's words where a kind of surface needs lines of sight and
// the folder tells of none. Any thread.
Result<MadeSurface> makeSurface(const PointCloud& cloud, const std::filesystem::path& folder,
                                const SurfaceWish& wish,
                                std::shared_ptr<const AlphaShape> alpha_shape, const Task& task);

}  // namespace gyre
