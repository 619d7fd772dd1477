// A controller board as the simulation runs it: bytes and times in, bytes out, a shaft turned.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gyre {

// Everything is a function of the bytes and times given: times are simulated seconds that never run
// backwards. One thread at a time.
class FirmwareBoard {
 public:
  virtual ~FirmwareBoard() = default;

  // Switched on, or reset by the host's DTR line: counts from 0 again, the shaft stays.
  virtual void reset(double time_s) = 0;
  // Bytes from the host; what arrives while the board boots is lost.
  virtual void receive(std::span<const std::byte> bytes, double time_s) = 0;
  virtual void advanceTo(double time_s) = 0;
  // The limit switch closes: what the firmware makes of it.
  virtual void pressLimitSwitch(double time_s) = 0;

  virtual std::string takeOutput() = 0;  // what was said since the last call
  // Something happens by itself soon: moving, waiting or booting.
  virtual bool busy() const = 0;

 protected:
  FirmwareBoard() = default;
  FirmwareBoard(const FirmwareBoard&) = default;
  FirmwareBoard& operator=(const FirmwareBoard&) = default;
};

}  // namespace gyre
