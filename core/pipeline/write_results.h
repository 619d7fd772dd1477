// Makes the mesh of a reconstruction and writes all that it leaves in its folder.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/angles_file.h"
#include "core/io/report.h"
#include "core/pipeline/reconstruction.h"
#include "core/scan/calibration_record.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_method.h"
#include "core/scan/scan.h"

namespace gyre {

// What is written beside the points.
struct ResultContext {
  CalibrationRecord calibration;                // as used
  AngleTable angles;                            // as the table was told
  std::vector<std::filesystem::path> pictures;  // in their order, for their fingerprint
  Report report;  // title, rights, options, inputs, seconds; the rest is filled in
};

struct WrittenResults {
  Mesh mesh;                              // empty when none could be made
  MeshMethod method = MeshMethod::kAuto;  // by which it was made
  std::optional<Error> mesh_problem;      // why
};

// Writes points.ply, visibility.bin, sightings.bin, silhouettes.bin, calibration.json,
// angles_solved.csv, report.json, report.html, and mesh.ply and mesh.obj: a surface of the points,
// or where they are too few the body that the outlines leave, where there are any; each file
// atomically. The folder is made when it is not there. Fails when a file cannot be written, and
// when stopped.
Result<WrittenResults> writeResults(const std::filesystem::path& folder,
                                    const Reconstruction& reconstruction,
                                    const ResultContext& context, const Task& task);

// Fails, with what to do about it, when a whole turn gave so few points that the views were too far
// apart, or the object is too plain to be measured by its texture.
Result<void> enoughPoints(const PointCloud& cloud, std::size_t views);

// The angle of each captured view by its file's name, as the program knew it.
AngleTable anglesOfViews(const std::vector<CapturedView>& views);

}  // namespace gyre
