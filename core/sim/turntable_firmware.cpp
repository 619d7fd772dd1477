// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/turntable_firmware.h"

#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "core/sim/grbl_board.h"
#include "core/sim/pipe_port.h"

namespace gyre {
namespace {

// Real seconds. While the motor turns the shaft is brought up to date this often; at rest only
// bytes matter, and they wake the thread.
constexpr double kTick_s = 0.001;
constexpr double kRest_s = 0.02;
constexpr double kWriteTimeout_s = 0.2;

}  // namespace

TurntableFirmware::TurntableFirmware(const TurntableFirmwareOptions& options,
                                     std::shared_ptr<Shaft> shaft, SimClock clock)
    : TurntableFirmware(std::make_unique<GrblBoard>(options, std::move(shaft)), clock) {}

TurntableFirmware::TurntableFirmware(std::unique_ptr<FirmwareBoard> board, SimClock clock)
    : clock_(clock),
      board_(std::move(board)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::unique_ptr<BytePort> TurntableFirmware::openPort() {
  auto [host, device] = PipePort::makePair("the simulated turntable");
  attach(std::move(device));
  return std::move(host);
}

void TurntableFirmware::attach(std::unique_ptr<BytePort> wire) {
  const std::scoped_lock lock(mutex_);
  board_->reset(clock_.seconds());
  board_->takeOutput();
  wire_ = std::move(wire);
}

bool TurntableFirmware::attached() const {
  const std::scoped_lock lock(mutex_);
  return wire_ != nullptr;
}

void TurntableFirmware::pressReset() {
  const std::scoped_lock lock(mutex_);
  board_->reset(clock_.seconds());
}

void TurntableFirmware::pressLimitSwitch() {
  const std::scoped_lock lock(mutex_);
  board_->pressLimitSwitch(clock_.seconds());
}

void TurntableFirmware::pullCable() {
  const std::scoped_lock lock(mutex_);
  wire_.reset();
}

void TurntableFirmware::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) exchangeBytes();
}

// Hears, moves on, answers. The wire is waited for without the lock.
void TurntableFirmware::exchangeBytes() {
  std::shared_ptr<BytePort> wire;
  double wait_s = kRest_s;
  {
    const std::scoped_lock lock(mutex_);
    wire = wire_;
    if (board_->busy()) wait_s = kTick_s;
  }
  std::array<std::byte, 256> buffer{};
  std::size_t count = 0;
  bool wire_lives = wire != nullptr;
  if (wire) {
    const Result<std::size_t> got = wire->read(buffer, wait_s);
    wire_lives = got.ok();
    if (got) count = *got;
  }
  if (!wire_lives) std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
  std::string answer;
  {
    const std::scoped_lock lock(mutex_);
    if (wire_ != wire) return;  // heard on a cable that is no longer plugged in
    if (!wire_lives) wire_.reset();
    board_->receive(std::span(buffer).first(count), clock_.seconds());
    answer = board_->takeOutput();
  }
  if (answer.empty() || !wire_lives) return;
  // An answer that nobody reads is lost, as on a real wire.
  if (!wire->write(std::as_bytes(std::span(answer)), kWriteTimeout_s)) return;
}

}  // namespace gyre
