// A simulated board at the end of a wire whose time passes only while its host waits: a minute is
// over at once, and every run is the same.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/device/byte_port.h"
#include "core/sim/firmware_board.h"

namespace gyre::test {

// The board, its time, and what happens to it at set times. One thread.
class SteppedRoom {
 public:
  explicit SteppedRoom(std::unique_ptr<FirmwareBoard> board) : board_(std::move(board)) {}

  double seconds() const { return time_s_; }
  FirmwareBoard& board() { return *board_; }
  void at(double time_s, std::function<void()> happening) {
    happenings_.push_back({time_s, std::move(happening)});
  }
  // Lets time pass, with nobody at the wire.
  void pass(double seconds);

  // The host's end of the cable. Opening it resets the board, like the DTR line of a real port; a
  // port that was open before is gone.
  std::unique_ptr<BytePort> openPort(const std::string& name);
  void pullCable() { ++plugged_; }
  const std::string& sent() const { return sent_; }

 private:
  class Port;
  struct Happening {
    double time_s;
    std::function<void()> what;
  };
  void step();

  std::unique_ptr<FirmwareBoard> board_;
  double time_s_ = 0.0;
  std::vector<Happening> happenings_;
  int plugged_ = 0;
  std::string unread_;
  std::string sent_;  // by the host, all of it
};

}  // namespace gyre::test
