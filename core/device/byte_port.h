// A two-way stream of bytes to a device, whatever carries it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace gyre {

// One thread uses a port at a time. Closing is destruction.
class BytePort {
 public:
  virtual ~BytePort() = default;

  // Waits until at least one byte is there and returns how many were read; 0 after the time-out.
  // kGone when the far end has vanished, kIo on any other failure.
  virtual Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) = 0;

  // Writes all bytes, or fails with kTimeout, kGone or kIo.
  virtual Result<void> write(std::span<const std::byte> bytes, double timeout_s) = 0;

  // The clock by which its waits run; deadlines of exchanges are told by it. Any thread.
  virtual double seconds() const { return steadySeconds(); }

  // How people know it: "/dev/ttyACM0", "tcp:192.168.4.1:23", "simulated turntable".
  virtual std::string name() const = 0;

 protected:
  BytePort() = default;
  BytePort(const BytePort&) = default;
  BytePort& operator=(const BytePort&) = default;
};

}  // namespace gyre
