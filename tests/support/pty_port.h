// The device's end of a pseudo terminal: the host opens path() like a serial port.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/device/byte_port.h"

namespace gyre {

// Destroying it is pulling the cable.
class PtyPort final : public BytePort {
 public:
  // Whether this machine can make one: /dev/pts may be missing in a container.
  static bool available();
  static std::unique_ptr<PtyPort> make();
  ~PtyPort() override;
  PtyPort(const PtyPort&) = delete;
  PtyPort& operator=(const PtyPort&) = delete;

  // Called in the thread that reads when the host has opened its end: the moment at which the DTR
  // line of a real port resets the board.
  void onOpened(std::function<void()> opened) { opened_ = std::move(opened); }
  const std::string& path() const { return path_; }  // "/dev/pts/3"

  // While no host has the port open, reads give nothing and writes are lost.
  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override;
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override;
  std::string name() const override { return path_; }

 private:
  PtyPort(int master, std::string path) : master_(master), path_(std::move(path)) {}

  int master_;
  std::string path_;
  std::function<void()> opened_;
  bool open_ = false;
};

}  // namespace gyre
