// A serial port, by libserialport: USB boards and true RS-232.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/device/byte_port.h"

struct sp_port;

namespace gyre {

// Held exclusively while open. Opening raises DTR, which restarts most boards.
class SerialPort final : public BytePort {
 public:
  // path: "/dev/ttyACM0", or a stable name under /dev/serial/by-id. 8 data bits, no parity, one
  // stop bit, no flow control. kNotFound, kNoPermission (with the cure), kBusy, kIo.
  static Result<std::unique_ptr<SerialPort>> open(const std::string& path, int baud = 115200);

  ~SerialPort() override;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override;
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override;
  std::string name() const override { return path_; }

 private:
  SerialPort(sp_port* port, std::string path);
  Error gone() const;

  sp_port* port_;  // owned: a C handle
  std::string path_;
};

// Why the user may not open the device file, with the cure; nothing when he may. The file is not
// opened.
std::optional<Error> portError(const std::string& path);

// The same as a sentence, empty when he may.
std::string portHindrance(const std::string& path);

}  // namespace gyre
