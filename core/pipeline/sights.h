// From where the cameras of a scan looked at its points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/mesh/sight_evidence.h"
#include "core/scan/calibration.h"
#include "core/scan/point_cloud.h"
#include "core/scan/silhouette.h"

namespace gyre {

// Camera centres at the table's angles, one for each view, and rays through the background beside
// the silhouettes, and the outlines, of some views spread over the turn. Where points of the cloud
// lie beside an outline, the outline is wrong: it is mended, and no ray is given. The calibration
// has its cam_from_table.
SightEvidence sightsOf(const Calibration& calibration, std::span<const double> table_angles_rad,
                       const Silhouettes& silhouettes, const PointCloud& cloud);

// The same from calibration.json, angles_solved.csv (a line for each view) and, where it is there,
// silhouettes.bin in a result's folder. Nothing when one of the first two is not there; fails when
// a file cannot be read, or the calibration does not say where the table is.
Result<std::optional<SightEvidence>> readSights(const std::filesystem::path& folder,
                                                const PointCloud& cloud);

}  // namespace gyre
