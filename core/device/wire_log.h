// Keeps what passes over a wire, with times and directions, for when something went wrong.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "core/device/byte_port.h"

namespace gyre {

// A text file, a line for each piece: "2026-05-04T10:11:12.345Z > G1X20\n". It is appended to; when
// it reaches its limit it becomes FILE.1, in place of the one before, so that both together take at
// most twice the limit. What cannot be written is dropped: a full disk does not stop a scan. Any
// thread.
class WireLog {
 public:
  // Makes the folder too. kIo and the like when the file cannot be written.
  static Result<std::shared_ptr<WireLog>> open(const std::filesystem::path& file,
                                               std::size_t limit_bytes = std::size_t{1} << 20);

  // direction: '>' from the host, '<' from the device, '=' what happened to the wire.
  void note(char direction, std::string_view bytes);
  const std::filesystem::path& file() const { return file_; }

 private:
  WireLog(std::filesystem::path file, std::size_t limit_bytes)
      : file_(std::move(file)), limit_bytes_(limit_bytes) {}
  void begin();

  std::mutex mutex_;
  const std::filesystem::path file_;
  const std::size_t limit_bytes_;
  std::ofstream stream_;
  std::size_t written_bytes_ = 0;
};

// The same port, with all that passes noted.
class LoggedPort final : public BytePort {
 public:
  LoggedPort(std::unique_ptr<BytePort> port, std::shared_ptr<WireLog> log);
  ~LoggedPort() override;
  LoggedPort(const LoggedPort&) = delete;
  LoggedPort& operator=(const LoggedPort&) = delete;

  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override;
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override;
  double seconds() const override { return port_->seconds(); }
  std::string name() const override { return port_->name(); }

 private:
  std::unique_ptr<BytePort> port_;
  std::shared_ptr<WireLog> log_;
  bool gone_ = false;
};

}  // namespace gyre
