// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scan_files.h"

#include <filesystem>
#include <string>
#include <utility>

#include "app/calibration_run.h"
#include "app/version.h"
#include "core/base/address.h"
#include "core/pipeline/options.h"

namespace gyre {

Result<WrittenResults> writeScanResults(const ScanStore& store,
                                        const Reconstruction& reconstruction, const Task& task) {
  const ScanSettings& settings = store.settings();
  ResultContext context;
  context.calibration = store.calibrationRecord();
  context.angles = anglesOfViews(store.views());
  for (const CapturedView& view : store.views()) {
    context.pictures.push_back(store.folder() / "frames" / view.file);
  }
  Report& report = context.report;
  report.title = settings.title;
  report.inventory_number = settings.inventory_number;
  report.rights = settings.rights;
  report.date = nowUtcText();
  report.versions["Gyre"] = programVersion();
  report.options = optionTexts(ReconstructOptions());  // a scan leaves them as they are
  report.options["views"] = std::to_string(settings.views);
  report.inputs["turntable"] = settings.turntable;
  report.inputs["camera"] = withoutPassword(settings.camera);
  if (!store.views().empty()) {
    report.inputs["captured"] = std::to_string(store.views().size()) + " views, " +
                                store.views().front().time_utc + " to " +
                                store.views().back().time_utc;
  }
  if (const auto done = writeAngles(store.folder() / "angles.csv", context.angles); !done) {
    return done.error();
  }
  return writeResults(store.folder(), reconstruction, context, task);
}

bool hasResults(const ScanStore& store) {
  std::error_code ignored;
  return std::filesystem::exists(store.folder() / "report.json", ignored);
}

}  // namespace gyre
