// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/faulty_port.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <vector>

namespace gyre {

// Returns false when the byte is lost.
bool FaultyPort::spoil(std::byte& byte) {
  if (random_.uniform() < faults_.drop) return false;
  if (random_.uniform() < faults_.corrupt) {
    byte ^= static_cast<std::byte>(1U << random_.below(8));
  }
  return true;
}

bool FaultyPort::count(std::size_t bytes) {
  bytes_ += static_cast<std::int64_t>(bytes);
  if (faults_.vanish_after_bytes >= 0 && bytes_ > faults_.vanish_after_bytes) vanished_ = true;
  return !vanished_;
}

void FaultyPort::arrive(std::byte byte) {
  if (faults_.mute_after_bytes >= 0 && from_device_++ >= faults_.mute_after_bytes) return;
  const double due_s = seconds() + faults_.delay_s;
  if (random_.uniform() < faults_.noise) {
    late_.push_back({due_s, static_cast<std::byte>(random_.below(256))});
  }
  if (spoil(byte)) late_.push_back({due_s, byte});
}

Result<std::size_t> FaultyPort::read(std::span<std::byte> buffer, double timeout_s) {
  const double deadline_s = seconds() + timeout_s;
  for (;;) {
    if (vanished_) return gone();
    const double now_s = seconds();
    std::size_t given = 0;
    const std::size_t most =
        faults_.split ? std::min<std::size_t>(1, buffer.size()) : buffer.size();
    while (given < most && !late_.empty() && late_.front().due_s <= now_s) {
      buffer[given++] = late_.front().byte;
      late_.pop_front();
    }
    if (given > 0 || now_s >= deadline_s) return given;
    double wait_s = deadline_s - now_s;
    if (!late_.empty()) wait_s = std::min(wait_s, late_.front().due_s - now_s);
    std::array<std::byte, 256> bytes{};
    const Result<std::size_t> got = port_->read(bytes, std::min(wait_s, 0.005));
    if (!got) return got;
    if (!count(*got)) return gone();
    for (const std::byte byte : std::span(bytes).first(*got)) arrive(byte);
  }
}

Result<void> FaultyPort::write(std::span<const std::byte> bytes, double timeout_s) {
  if (vanished_ || !count(bytes.size())) return gone();
  std::vector<std::byte> left;
  for (std::byte byte : bytes) {
    if (faults_.host_is_heard_well || spoil(byte)) left.push_back(byte);
  }
  return left.empty() ? Result<void>() : port_->write(left, timeout_s);
}

}  // namespace gyre
