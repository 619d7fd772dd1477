// A byte pipe within the program: what one end writes, the other reads.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/device/byte_port.h"

namespace gyre {

// One of the two ends. When an end is destroyed, the other reads what is left and then sees kGone,
// as with a cable pulled. Each end may be used by a thread of its own.
class PipePort final : public BytePort {
 public:
  // Two connected ends: the host's, then the device's.
  static std::pair<std::unique_ptr<PipePort>, std::unique_ptr<PipePort>> makePair(std::string name);

  ~PipePort() override;
  PipePort(const PipePort&) = delete;
  PipePort& operator=(const PipePort&) = delete;

  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override;
  // Waits while the far end has 64 KiB unread.
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override;
  std::string name() const override;

 private:
  struct Wire;
  PipePort(std::shared_ptr<Wire> wire, int side) : wire_(std::move(wire)), side_(side) {}
  Error gone() const;

  std::shared_ptr<Wire> wire_;
  int side_;
};

}  // namespace gyre
