// What the window's jobs do with a rig and with files, as plain functions without a window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/empty_table.h"
#include "app/rig.h"
#include "app/scan_run.h"
#include "app/take_up_scan.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/reconstruction.h"
#include "core/pipeline/write_results.h"
#include "core/scan/calibration_record.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"
#include "core/scan/point_cloud.h"
#include "core/scan/scan.h"
#include "core/scan/scan_pass.h"

namespace gyre {

enum class ScanBegin {
  kNew,
  kResumed,         // the folder holds a scan; settings and calibration are its own
  kResumedInPlace,  // likewise, and the turntable still knows its angle
};

struct ScanPlan {
  std::filesystem::path folder;
  ScanBegin begin = ScanBegin::kNew;
  TakeUp take_up = TakeUp::kProve;  // for kResumed
  ScanSettings settings;
  CalibrationRecord calibration;
  std::filesystem::path reference;  // picture by which a bump since is told; may be missing
  std::optional<EmptyTable> empty_table;
};

struct ScanSessionResult {
  Reconstruction reconstruction;
  WrittenResults results;
  std::optional<Error> problem;  // too few points, no mesh, a bump: shown beside what there is
};

// The whole way from an open rig to a folder with results. On failure, and when stopped, what was
// captured stays in the folder.
Result<ScanSessionResult> runScanSession(Rig& rig, const ScanPlan& plan,
                                         const ScanObserver& observer, const Task& task);

struct OpenedModel {
  std::filesystem::path scan_folder;  // or a result's; empty when a model's file was opened
  PointCloudPtr cloud;                // null when there is none
  MeshPtr mesh;
  MeshHealth health;
  std::optional<CalibrationRecord> calibration;
  std::vector<ScanPass> passes;  // of which it was merged; empty for all others
  int views = 0;
  int views_done = 0;
};

// Reads a scan's folder or .gyre file with the results beside it, the folder of another result (of
// merged passes also by its passes.json), or a .ply, .obj or .stl.
Result<OpenedModel> openScanOrModel(const std::filesystem::path& named, const Task& task);

// Half of the points are surer than this; nothing when there are none. [mm]
std::optional<double> medianSigmaMm(const PointCloud& cloud);

}  // namespace gyre
