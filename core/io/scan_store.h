// A scan's folder: settings, frames and the journal that survives anything.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/io/scan_journal.h"
#include "core/scan/calibration_record.h"
#include "core/scan/frame.h"
#include "core/scan/scan.h"

namespace gyre {

// The file of a view below frames/.
std::string viewFileName(int view);

// NAME/ with NAME.gyre, frames/, empty/, journal.jsonl and calibration.json in it. After addView()
// has returned, the view is on the disk: the file and its journal line are written and synced.
// Whatever instant the program is killed at, open() finds every view whose addView() had returned.
// While a store lives, no other program can open the scan. One thread at a time.
class ScanStore {
 public:
  // Makes the folder with settings and calibration in it, all or nothing. Fails when the folder
  // exists and is not empty, and then touches nothing; when it cannot be written; or with kNoSpace
  // when the disk has no room for all views (bytesForScan).
  static Result<ScanStore> create(const std::filesystem::path& folder, const ScanSettings& settings,
                                  const CalibrationRecord& calibration);

  // Opens the folder, or the .gyre file in it. A torn last journal line, pictures without a line
  // and lines without a whole picture are what a kill leaves behind: they are dropped. kBusy when
  // the scan is open in another program.
  static Result<ScanStore> open(const std::filesystem::path& folder_or_file);

  const std::filesystem::path& folder() const { return folder_; }
  const ScanSettings& settings() const { return settings_; }
  const Calibration& calibration() const { return record_.calibration; }
  const CalibrationRecord& calibrationRecord() const { return record_; }
  const std::vector<CapturedView>& views() const { return views_; }  // ascending
  bool complete() const;  // every view of the settings is captured
  // What was remarked while the scan was taken, in earlier runs as well.
  const std::vector<ScanRemark>& remarks() const { return remarks_; }

  // Writes the picture losslessly, syncs it, appends and syncs the journal line. The frame's view
  // must be one of the settings; a view that is there already is replaced. sharpness: any measure
  // that grows with it, for the journal.
  Result<void> addView(const Frame& frame, std::int64_t steps, double sharpness = 0.0);

  // Keeps a sentence for the user: written and synced like a view.
  Result<void> addRemark(int view, const std::string& text);

  // Keeps the picture of the bare table with its angle; one that is there already is replaced.
  Result<void> addEmptyTable(const Frame& frame);

  Result<FramePtr> readView(const CapturedView& view) const;
  Result<FramePtr> readEmptyTable() const;  // kNotFound when there is none

 private:
  explicit ScanStore(ScanJournal journal) : journal_(std::move(journal)) {}

  std::filesystem::path folder_;
  ScanSettings settings_;
  CalibrationRecord record_;
  ScanJournal journal_;
  std::vector<CapturedView> views_;
  std::vector<ScanRemark> remarks_;
};

}  // namespace gyre
