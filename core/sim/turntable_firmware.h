// The simulated turntable: a board, its motor, and a thread that runs them in simulated time.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <thread>

#include "core/device/byte_port.h"
#include "core/sim/firmware_board.h"
#include "core/sim/grbl_settings.h"
#include "core/sim/shaft.h"
#include "core/sim/sim_clock.h"

namespace gyre {

// Any thread may call any member. The thread ends with the object; the motor then stands.
class TurntableFirmware {
 public:
  // With GRBL on the board.
  TurntableFirmware(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft,
                    SimClock clock);
  TurntableFirmware(std::unique_ptr<FirmwareBoard> board, SimClock clock);
  ~TurntableFirmware() = default;
  TurntableFirmware(const TurntableFirmware&) = delete;
  TurntableFirmware& operator=(const TurntableFirmware&) = delete;

  // The host's end of the cable. Opening it resets the board, as the DTR line of a real one does;
  // a port that was open before is gone.
  std::unique_ptr<BytePort> openPort();

  // The same over any other wire: bytes are read from and written to it until it is gone.
  void attach(std::unique_ptr<BytePort> wire);
  bool attached() const;

  // What can happen to a board at any time.
  void pressReset();        // or its power failed for a moment
  void pressLimitSwitch();  // ALARM:1 when $21 is set
  void pullCable();         // the host's port is gone; motion that was asked for goes on

 private:
  void run(const std::stop_token& stop);
  void exchangeBytes();

  SimClock clock_;
  mutable std::mutex mutex_;  // guards what follows
  std::unique_ptr<FirmwareBoard> board_;
  std::shared_ptr<BytePort> wire_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace gyre
