// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scan_files.h"

#include <filesystem>
#include <string>
#include <utility>

#include "app/version.h"
#include "core/pipeline/options.h"

namespace gyre {

Result<WrittenResults> writeScanResults(const ScanStore& store,
                                        const Reconstruction& reconstruction, const Task& task) {
  const ScanSettings& settings = store.settings();
  ResultContext context;
  context.calibration = store.calibrationRecord();
  context.angles = anglesOfViews(store.views());
  Report& report = context.report;
  report.title = settings.title;
  report.inventory_number = settings.inventory_number;
  report.rights = settings.rights;
  report.versions["Gyre"] = programVersion();
  report.options = optionTexts(ReconstructOptions());  // a scan leaves them as they are
  report.options["views"] = std::to_string(settings.views);
  report.inputs["turntable"] = settings.turntable;
  report.inputs["camera"] = settings.camera;
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
