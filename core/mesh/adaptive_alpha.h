// Makes a mesh of a cloud by an alpha shape whose alpha follows the spacing of the points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/alpha_shape.h"
#include "core/mesh/options.h"
#include "core/mesh/sight_evidence.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// As alphaShapeMesh, but each neighbourhood is thinned to its own spacing, alpha is a multiple of
// it (alpha_spacings; alpha_mm is not asked), and facets that lines of sight pass through are left
// out. So one surface follows a densely sampled face and a sparse back. Without sights no facet is
// left out. alpha_mm and spacing_mm of the result are medians. Fails as alphaShapeMesh does.
Result<AlphaShapeMesh> adaptiveAlphaMesh(const PointCloud& cloud, const SightEvidence& sights,
                                         const AlphaShapeOptions& options, const Task& task);

}  // namespace gyre
