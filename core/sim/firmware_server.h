// Serves the simulated turntable on a TCP port of this machine, for other programs and for tests.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <thread>
#include <utility>

#include "core/base/result.h"
#include "core/sim/turntable_firmware.h"

namespace gyre {

// Listens on 127.0.0.1 only. One host at a time, as on a serial cable: while one is connected,
// others are turned away. A connection resets the board.
class FirmwareServer {
 public:
  // port 0 picks a free one. kBusy when the port is taken, kInvalidInput when it is no port.
  static Result<std::unique_ptr<FirmwareServer>> start(std::shared_ptr<TurntableFirmware> firmware,
                                                       int port);
  ~FirmwareServer();
  FirmwareServer(const FirmwareServer&) = delete;
  FirmwareServer& operator=(const FirmwareServer&) = delete;

  int port() const { return port_; }

 private:
  FirmwareServer(std::shared_ptr<TurntableFirmware> firmware, int socket, int port);
  void run(const std::stop_token& stop);

  std::shared_ptr<TurntableFirmware> firmware_;
  int socket_;
  int port_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace gyre
