// Keeps the log of a turntable's wire with the scan that it belongs to.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "core/base/result.h"

namespace gyre {

inline constexpr const char* kKeptWireLog = "wire.log";  // in the scan's folder

// Copies the latest lines of the log of this turntable's wire into the folder, in place of an older
// copy; whole lines only. Copies nothing, and succeeds, when the turntable has no wire or nothing
// was logged. limit_bytes: the copy is at most as long. > 0
Result<void> keepWireLog(const std::string& turntable_word, const std::filesystem::path& folder,
                         std::size_t limit_bytes = std::size_t{1} << 20);

// Does so when it goes, however the scan ends. A copy that fails does not spoil the scan: the log
// still lies in the user's cache.
class WireLogKeeper {
 public:
  WireLogKeeper(std::string turntable_word, std::filesystem::path folder)
      : turntable_word_(std::move(turntable_word)), folder_(std::move(folder)) {}
  ~WireLogKeeper() { (void)keepWireLog(turntable_word_, folder_); }
  WireLogKeeper(const WireLogKeeper&) = delete;
  WireLogKeeper& operator=(const WireLogKeeper&) = delete;

 private:
  std::string turntable_word_;
  std::filesystem::path folder_;
};

}  // namespace gyre
