// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/kept_wire_log.h"

#include <system_error>

#include "app/rig.h"
#include "app/table_at_port.h"
#include "app/turntable_word.h"
#include "core/base/check.h"
#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"

namespace gyre {
namespace {

// A wire's log and the one before it; each is a little longer than a megabyte at most.
constexpr std::uintmax_t kMostRead_bytes = 8U << 20U;

}  // namespace

Result<void> keepWireLog(const std::string& turntable_word, const std::filesystem::path& folder,
                         std::size_t limit_bytes) {
  GYRE_CHECK(limit_bytes > 0);
  if (namesSimulation(turntable_word)) return {};
  const auto word = turntableWord(turntable_word);
  if (!word || word->port.empty()) return {};
  const std::filesystem::path log = wireLogFile(word->port);
  std::string text;
  for (const std::filesystem::path& file : {std::filesystem::path(log.string() + ".1"), log}) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed)) continue;
    const auto part = readFileBytes(file, kMostRead_bytes);
    if (!part) return part.error();
    text += *part;
  }
  if (text.empty()) return {};
  if (text.size() > limit_bytes) {
    const std::size_t line_end = text.find('\n', text.size() - limit_bytes - 1);
    text.erase(0, line_end == std::string::npos ? text.size() : line_end + 1);
  }
  return writeFileAtomically(folder / kKeptWireLog, text);
}

}  // namespace gyre
