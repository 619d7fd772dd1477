// A wire gone bad: drops, corrupts, splits and delays what another port carries, or vanishes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>

#include "core/base/random.h"
#include "core/device/byte_port.h"

namespace gyre {

struct Faults {
  std::uint64_t seed = 1;
  double drop = 0.0;                     // probability a byte is lost, either way
  double corrupt = 0.0;                  // probability a byte has one bit flipped, either way
  double delay_s = 0.0;                  // how late bytes from the device arrive
  bool split = false;                    // reads give one byte at a time
  double noise = 0.0;                    // probability a stray byte comes before one of the device
  std::int64_t mute_after_bytes = -1;    // from the device nothing comes after so many; -1: never
  bool host_is_heard_well = false;       // what the host sends arrives unharmed
  std::int64_t vanish_after_bytes = -1;  // read and written together; -1: never
};

// Faults may be changed while no call is under way; vanish() at any time, from any thread.
class FaultyPort final : public BytePort {
 public:
  FaultyPort(std::unique_ptr<BytePort> port, const Faults& faults)
      : port_(std::move(port)), faults_(faults), random_(faults.seed) {}

  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override;
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override;
  std::string name() const override { return port_->name(); }
  double seconds() const override { return port_->seconds(); }

  void setFaults(const Faults& faults) {
    faults_ = faults;
    from_device_ = 0;
  }
  void vanish() { vanished_ = true; }

 private:
  struct Late {
    double due_s;
    std::byte byte;
  };
  bool spoil(std::byte& byte);
  bool count(std::size_t bytes);
  void arrive(std::byte byte);
  static Error gone() { return {Error::Code::kGone, "The faulty port has vanished.", ""}; }

  std::unique_ptr<BytePort> port_;
  Faults faults_;
  Random random_;
  std::deque<Late> late_;
  std::int64_t bytes_ = 0;
  std::int64_t from_device_ = 0;
  std::atomic<bool> vanished_ = false;
};

}  // namespace gyre
