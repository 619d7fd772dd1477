// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/wire_log.h"

#include <chrono>
#include <ctime>
#include <system_error>

#include "core/base/formatted.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

std::string nowText() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  const auto seconds = static_cast<std::time_t>(ms / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  return formatted("%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", utc.tm_year + 1900, utc.tm_mon + 1,
                   utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, static_cast<int>(ms % 1000));
}

std::string escaped(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    if (c == '\n') {
      text += "\\n";
    } else if (c == '\r') {
      text += "\\r";
    } else if (c == '\\') {
      text += "\\\\";
    } else if (c >= ' ' && c <= '~') {
      text += c;
    } else {
      text += formatted("\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
  }
  return text;
}

std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Result<std::shared_ptr<WireLog>> WireLog::open(const fs::path& file, std::size_t limit_bytes) {
  std::error_code failed;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
  std::shared_ptr<WireLog> log(new WireLog(file, limit_bytes));
  log->begin();
  if (!log->stream_) {
    return Error{Error::Code::kIo, "The wire log " + file.string() + " cannot be written.",
                 "Look at the rights of its folder and at the room on the disk."};
  }
  return log;
}

void WireLog::begin() {
  std::error_code none;
  const auto size = fs::file_size(file_, none);
  written_bytes_ = none ? 0 : static_cast<std::size_t>(size);
  stream_.open(file_, std::ios::app | std::ios::binary);
}

void WireLog::note(char direction, std::string_view bytes) {
  const std::string line = nowText() + " " + direction + " " + escaped(bytes) + "\n";
  const std::scoped_lock lock(mutex_);
  if (written_bytes_ + line.size() > limit_bytes_ && written_bytes_ > 0) {
    stream_.close();
    std::error_code failed;
    fs::rename(file_, file_.string() + ".1", failed);
    if (failed) fs::remove(file_, failed);
    stream_.clear();
    begin();
  }
  stream_.clear();
  stream_ << line << std::flush;
  written_bytes_ += line.size();
}

LoggedPort::LoggedPort(std::unique_ptr<BytePort> port, std::shared_ptr<WireLog> log)
    : port_(std::move(port)), log_(std::move(log)) {
  log_->note('=', "opened " + port_->name());
}

LoggedPort::~LoggedPort() { log_->note('=', "closed"); }

Result<std::size_t> LoggedPort::read(std::span<std::byte> buffer, double timeout_s) {
  const Result<std::size_t> count = port_->read(buffer, timeout_s);
  if (count && *count > 0) log_->note('<', textOf(buffer.first(*count)));
  if (!count && !std::exchange(gone_, true)) log_->note('=', count.error().what);
  return count;
}

Result<void> LoggedPort::write(std::span<const std::byte> bytes, double timeout_s) {
  log_->note('>', textOf(bytes));
  Result<void> written = port_->write(bytes, timeout_s);
  if (!written) log_->note('=', written.error().what);
  return written;
}

}  // namespace gyre
