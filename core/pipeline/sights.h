// From where the cameras of a scan looked at its points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/mesh/sight_evidence.h"
#include "core/pipeline/result_views.h"
#include "core/scan/point_cloud.h"
#include "core/scan/silhouette.h"

namespace gyre {

// The cameras' centres, one for each view, and rays through the background beside the silhouettes,
// and the outlines, of some views spread over each pass (all views, where nobody turned the object
// over). Where points of the cloud lie beside an outline, the outline is wrong: it is mended, and
// no ray is given.
SightEvidence sightsOf(const ResultViews& views, const Silhouettes& silhouettes,
                       const PointCloud& cloud);

// The same from a result's folder (readResultViews) and, where it is there, its silhouettes.bin.
// Nothing when the folder does not tell where the cameras were; fails when a file cannot be read,
// or the calibration does not say where the table is.
Result<std::optional<SightEvidence>> readSights(const std::filesystem::path& folder,
                                                const PointCloud& cloud);

}  // namespace gyre
