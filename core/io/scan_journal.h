// journal.jsonl: one line for each captured view, synced before the table moves on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/io/unique_fd.h"
#include "core/scan/scan.h"

namespace gyre {

// While it lives, no other program can open the same journal: it is the lock of the whole scan.
class ScanJournal {
 public:
  // Opens or makes the file. A last line without its end, as a kill leaves it, is cut off; other
  // lines that are no views are passed over. kBusy when another program holds it. On a disk that
  // can only be read, the journal opens and append() fails.
  static Result<ScanJournal> open(const std::filesystem::path& file);

  // The views in the file when it was opened: ascending, for each view the last line.
  const std::vector<CapturedView>& views() const { return views_; }

  // The remarks in the file when it was opened, in their order.
  const std::vector<ScanRemark>& remarks() const { return remarks_; }

  // When these return success, the line is on the disk. On failure the file is as it was.
  Result<void> append(const CapturedView& view);
  Result<void> append(const ScanRemark& remark);

 private:
  ScanJournal() = default;

  Result<void> appendLine(const std::string& line);

  std::filesystem::path file_;
  UniqueFd fd_;
  std::uintmax_t size_ = 0;  // of the whole lines
  std::vector<CapturedView> views_;
  std::vector<ScanRemark> remarks_;
};

// A view or a remark as a line of the journal, with its line feed.
std::string journalLine(const CapturedView& view);
std::string journalLine(const ScanRemark& remark);

}  // namespace gyre
