// What the window's jobs do with a rig and with files, as plain functions without a window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scan_session.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "app/calibrated_rig.h"
#include "app/count_anew.h"
#include "app/empty_table.h"
#include "app/kept_wire_log.h"
#include "app/scan_files.h"
#include "core/base/median.h"
#include "core/io/calibration_record_file.h"
#include "core/io/model_file.h"
#include "core/io/passes_file.h"
#include "core/io/scan_settings_file.h"
#include "core/io/scan_store.h"
#include "core/io/visibility_file.h"
#include "core/mesh/mesh_health.h"
#include "core/sim/rig_json.h"

namespace gyre {
namespace {

constexpr const char* kEmptyTableLost =
    "Where the table stood for the picture of the empty table is not known any more: ";

void tell(const ScanObserver& observer, const std::string& remark) {
  if (observer.on_remark) observer.on_remark(remark);
}

// A scan that goes on turns the table as it was turned before.
Result<ScanStore> openedStore(const Rig& rig, const ScanPlan& plan) {
  auto store = ScanStore::open(plan.folder);
  if (!store) return store;
  const ScanSettings& settings = store->settings();
  const auto matched = matchTurning(rig, settings.units_per_turn, settings.direction);
  if (!matched) return matched.error();
  return store;
}

Result<ScanStore> storeFor(const Rig& rig, const ScanPlan& plan, const ScanObserver& observer,
                           const Task& task) {
  if (plan.begin != ScanBegin::kNew) return openedStore(rig, plan);
  const auto remarks = prepareRig(rig, plan.calibration, plan.reference, task);
  if (!remarks) return remarks.error();
  for (const std::string& remark : *remarks) tell(observer, remark);
  ScanSettings settings = plan.settings;
  const TurntableInfo info = rig.turntable->info();
  settings.units_per_turn = info.units_per_turn;
  settings.direction = info.direction;
  settings.camera_controls = rig.camera->info().controls;
  if (rig.room) settings.sim_rig_json = rigToJson(rig.room->settings);
  return ScanStore::create(plan.folder, settings, plan.calibration);
}

Result<void> prepareTable(const Rig& rig, const ScanPlan& plan, const ScanObserver& observer,
                          ScanStore& store, const Task& task) {
  if (plan.begin != ScanBegin::kNew) {
    if (rig.room) rig.room->setTable(TableLoad::kObject);
    if (plan.begin == ScanBegin::kResumedInPlace) return {};
    const auto taken_up = takeUpScan(rig, store, plan.take_up, task);
    if (!taken_up) {
      const Error& error = taken_up.error();
      if (error.code == Error::Code::kRejected && observer.on_objection) {
        observer.on_objection(error);
      }
      return error;
    }
    for (const std::string& remark : *taken_up) tell(observer, remark);
    return {};
  }
  if (plan.empty_table) {
    const auto kept = keepEmptyTable(*plan.empty_table, *rig.turntable, store);
    if (!kept) return kept.error();
    if (!*kept) {
      tell(observer, std::string(kEmptyTableLost) +
                         (rig.room ? "it is taken again." : "the object is told by its motion."));
    }
  }
  return takeEmptyTable(rig, store, task);
}

// A folder with points of which no scan tells: they were merged, or made of pictures.
bool isBareResult(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "points.ply", ignored)) return false;
  const auto scan = scanSettingsFileIn(folder);
  return !scan && scan.error().code == Error::Code::kNotFound;
}

Result<void> openScan(const std::filesystem::path& path, OpenedModel& opened) {
  const auto store = ScanStore::open(path);
  if (!store) return store.error();
  opened.scan_folder = store->folder();
  opened.calibration = store->calibrationRecord();
  opened.views = store->settings().views;
  opened.views_done = static_cast<int>(store->views().size());
  return {};
}

Result<void> openResult(const std::filesystem::path& folder, OpenedModel& opened) {
  opened.scan_folder = folder;
  std::error_code ignored;
  if (const auto file = folder / "calibration.json"; std::filesystem::exists(file, ignored)) {
    auto record = readCalibrationRecord(file);
    if (!record) return record.error();
    opened.calibration = std::move(record).value();
  }
  if (const auto file = folder / kPassesFile; std::filesystem::exists(file, ignored)) {
    auto passes = readPasses(file);
    if (!passes) return passes.error();
    opened.passes = std::move(passes).value();
    for (const ScanPass& pass : opened.passes) opened.views += static_cast<int>(pass.views);
  }
  opened.views_done = opened.views;
  return {};
}

}  // namespace

Result<ScanSessionResult> runScanSession(Rig& rig, const ScanPlan& plan,
                                         const ScanObserver& observer, const Task& task) {
  if (plan.begin == ScanBegin::kNew) {
    if (const auto counted = countAnewIfLost(*rig.turntable); !counted) return counted.error();
  }
  auto store = storeFor(rig, plan, observer, task);
  if (!store) return store.error();
  const WireLogKeeper wire(plan.settings.turntable, store->folder());
  if (const auto ready = prepareTable(rig, plan, observer, *store, task); !ready)
    return ready.error();
  auto reconstruction = runScan(*rig.turntable, *rig.camera, *store, observer, task.part(0.0, 0.9));
  if (!reconstruction) return reconstruction.error();
  if (reconstruction->turning && reconstruction->turning->lostSteps()) {
    tell(observer, reconstruction->turning->sentence);
  }
  auto results = writeScanResults(*store, *reconstruction, task.part(0.9, 1.0));
  if (!results) return results.error();
  std::optional<Error> problem = results->mesh_problem;
  if (!problem && reconstruction->drift.firstMoved() != nullptr) {
    problem = Error{Error::Code::kRejected, reconstruction->drift.sentence, ""};
  }
  const auto enough = enoughPoints(reconstruction->cloud, store->views().size());
  if (!enough) problem = enough.error();
  return ScanSessionResult{std::move(reconstruction).value(), std::move(results).value(), problem};
}

Result<OpenedModel> openScanOrModel(const std::filesystem::path& named, const Task& task) {
  OpenedModel opened;
  const std::filesystem::path path = named.filename() == kPassesFile ? named.parent_path() : named;
  std::filesystem::path points = path;
  std::filesystem::path mesh;
  std::error_code ignored;
  if (path.extension() == ".gyre" || std::filesystem::is_directory(path, ignored)) {
    const auto known = isBareResult(path) ? openResult(path, opened) : openScan(path, opened);
    if (!known) return known.error();
    points = opened.scan_folder / "points.ply";
    mesh = opened.scan_folder / "mesh.ply";
    if (!std::filesystem::exists(points, ignored)) return opened;
  }
  task.report(0.2, "Reading the points");
  auto model = readMeshOrCloud(points);
  if (!model) return model.error();
  if (auto* cloud = std::get_if<PointCloud>(&*model)) {
    // Closed surfaces follow the views that saw each point. Where the file is missing, or about
    // other points, the cloud is shown all the same, as seen from nowhere.
    if (!opened.scan_folder.empty()) {
      (void)readVisibility(opened.scan_folder / "visibility.bin", *cloud);
    }
    opened.cloud = std::make_shared<const PointCloud>(std::move(*cloud));
    if (mesh.empty() || !std::filesystem::exists(mesh, ignored)) return opened;
    model = readMeshOrCloud(mesh);
    if (!model) return model.error();
  }
  if (auto* surface = std::get_if<Mesh>(&*model)) {
    opened.health = meshHealth(*surface);
    opened.mesh = std::make_shared<const Mesh>(std::move(*surface));
  }
  return opened;
}

std::optional<double> medianSigmaMm(const PointCloud& cloud) {
  if (cloud.points.empty()) return std::nullopt;
  std::vector<double> sigmas;
  sigmas.reserve(cloud.points.size());
  for (const Point& point : cloud.points) sigmas.push_back(point.sigmaMm());
  return median(std::move(sigmas));
}

}  // namespace gyre
