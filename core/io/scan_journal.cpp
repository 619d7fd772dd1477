// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/io/file_bytes.h"
#include "core/io/scan_settings_file.h"

namespace gyre {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::uintmax_t kMaxBytes = 1U << 30U;

// A name in the frames folder and not a way out of it.
bool isPlainName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

std::optional<CapturedView> parseLine(std::string_view line) {
  const json entry = json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!entry.is_object()) return std::nullopt;
  const json number = entry.value("view", json());
  const json file = entry.value("file", json());
  const json angle = entry.value("table_angle_rad", json());
  const json steps = entry.value("steps", json());
  if (!number.is_number_integer() || !file.is_string() || !angle.is_number() ||
      !steps.is_number_integer()) {
    return std::nullopt;
  }
  if (number < 0 || number >= kMaxViews) return std::nullopt;
  CapturedView view;
  view.view = number.get<int>();
  view.file = file.get<std::string>();
  view.table_angle_rad = angle.get<double>();
  view.steps = steps.get<std::int64_t>();
  const json sharpness = entry.value("sharpness", json());
  if (sharpness.is_number()) view.sharpness = sharpness.get<double>();
  const json time = entry.value("time_utc", json());
  if (time.is_string()) view.time_utc = time.get<std::string>();
  if (!isPlainName(view.file) || !std::isfinite(view.table_angle_rad)) return std::nullopt;
  return view;
}

std::vector<CapturedView> parseLines(std::string_view lines) {
  std::map<int, CapturedView> by_view;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    if (auto view = parseLine(lines.substr(0, end))) by_view[view->view] = std::move(*view);
    lines.remove_prefix(end + 1);
  }
  std::vector<CapturedView> views;
  views.reserve(by_view.size());
  for (auto& [number, view] : by_view) views.push_back(std::move(view));
  return views;
}

std::vector<ScanRemark> parseRemarks(std::string_view lines) {
  std::vector<ScanRemark> remarks;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    const json entry = json::parse(lines.substr(0, end), nullptr, /*allow_exceptions=*/false);
    lines.remove_prefix(end + 1);
    if (!entry.is_object()) continue;
    const json text = entry.value("remark", json());
    const json view = entry.value("at_view", json());
    const json time = entry.value("time_utc", json());
    if (!text.is_string() || !view.is_number_integer() || view < 0 || view >= kMaxViews) continue;
    remarks.push_back({view.get<int>(), text.get<std::string>(),
                       time.is_string() ? time.get<std::string>() : std::string()});
  }
  return remarks;
}

// Returns 0 or the error number.
int writeAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

std::string journalLine(const CapturedView& view) {
  ordered_json entry;
  entry["view"] = view.view;
  entry["file"] = view.file;
  entry["table_angle_rad"] = view.table_angle_rad;
  entry["steps"] = view.steps;
  entry["sharpness"] = view.sharpness;
  entry["time_utc"] = view.time_utc;
  return entry.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string journalLine(const ScanRemark& remark) {
  ordered_json entry;
  entry["at_view"] = remark.view;
  entry["remark"] = remark.text;
  entry["time_utc"] = remark.time_utc;
  return entry.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<ScanJournal> ScanJournal::open(const std::filesystem::path& file) {
  ScanJournal journal;
  journal.file_ = file;
  const int flags = O_CLOEXEC | O_APPEND | O_NONBLOCK;
  journal.fd_ = UniqueFd(::open(file.c_str(), O_RDWR | O_CREAT | flags, 0666));
  const bool read_only = !journal.fd_.valid() && (errno == EROFS || errno == EACCES);
  if (read_only) journal.fd_ = UniqueFd(::open(file.c_str(), O_RDONLY | flags));
  if (!journal.fd_.valid()) return fileError(errno, "open", file);
  if (::flock(journal.fd_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return fileError(errno, "lock", file);
    return Error{Error::Code::kBusy,
                 "The scan \"" + file.parent_path().string() + "\" is open in another program.",
                 "Close it there, then try again."};
  }
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  journal.size_ = bytes->rfind('\n') + 1;  // npos + 1 is 0
  if (journal.size_ < bytes->size() && !read_only &&
      ::ftruncate(journal.fd_.get(), static_cast<off_t>(journal.size_)) != 0) {
    return fileError(errno, "repair", file);
  }
  const std::string_view whole_lines = std::string_view(*bytes).substr(0, journal.size_);
  journal.views_ = parseLines(whole_lines);
  journal.remarks_ = parseRemarks(whole_lines);
  return journal;
}

Result<void> ScanJournal::append(const CapturedView& view) { return appendLine(journalLine(view)); }

Result<void> ScanJournal::append(const ScanRemark& remark) {
  return appendLine(journalLine(remark));
}

Result<void> ScanJournal::appendLine(const std::string& line) {
  int problem = writeAll(fd_.get(), line);
  if (problem == 0 && ::fsync(fd_.get()) != 0) problem = errno;
  if (problem != 0) {
    // Half a line at the end would spoil the next one; if even this fails, open() cuts it off.
    static_cast<void>(::ftruncate(fd_.get(), static_cast<off_t>(size_)) == 0);
    return fileError(problem == EBADF ? EROFS : problem, "write", file_);
  }
  size_ += line.size();
  return {};
}

}  // namespace gyre
