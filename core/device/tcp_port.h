// A port over the network: FluidNC, ser2net, the simulated firmware.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/device/byte_port.h"

namespace gyre {

class TcpPort final : public BytePort {
 public:
  // address: "HOST:PORT", "[IPV6]:PORT", with or without "tcp:" before it. The time-out covers the
  // connection; looking up the name of a host takes what the system's resolver takes.
  // kInvalidInput, kNotFound, kRejected when nothing listens, kTimeout.
  static Result<std::unique_ptr<TcpPort>> open(const std::string& address, double timeout_s);

  // Takes over a connected socket.
  static std::unique_ptr<TcpPort> adopt(int socket, std::string name);

  ~TcpPort() override;
  TcpPort(const TcpPort&) = delete;
  TcpPort& operator=(const TcpPort&) = delete;

  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override;
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override;
  std::string name() const override { return name_; }

 private:
  TcpPort(int socket, std::string name) : socket_(socket), name_(std::move(name)) {}
  Error failure(int error_number) const;

  int socket_;
  std::string name_;
};

}  // namespace gyre
