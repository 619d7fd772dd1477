// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/pipe_port.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace gyre {
namespace {
constexpr std::size_t kCapacity = std::size_t{64} << 10;
}  // namespace

// Both directions. waiting[s] holds what side s has yet to read.
struct PipePort::Wire {
  std::string name;
  std::mutex mutex;
  std::condition_variable changed;
  std::array<std::deque<std::byte>, 2> waiting;
  std::array<bool, 2> present{true, true};
};

std::pair<std::unique_ptr<PipePort>, std::unique_ptr<PipePort>> PipePort::makePair(
    std::string name) {
  auto wire = std::make_shared<Wire>();
  wire->name = std::move(name);
  return {std::unique_ptr<PipePort>(new PipePort(wire, 0)),
          std::unique_ptr<PipePort>(new PipePort(wire, 1))};
}

PipePort::~PipePort() {
  const std::scoped_lock lock(wire_->mutex);
  wire_->present.at(static_cast<std::size_t>(side_)) = false;
  wire_->changed.notify_all();
}

std::string PipePort::name() const { return wire_->name; }

Error PipePort::gone() const {
  return {Error::Code::kGone, "The connection to " + wire_->name + " has ended.", ""};
}

Result<std::size_t> PipePort::read(std::span<std::byte> buffer, double timeout_s) {
  const auto mine = static_cast<std::size_t>(side_);
  std::unique_lock lock(wire_->mutex);
  auto& waiting = wire_->waiting.at(mine);
  const bool& far_end_present = wire_->present.at(1 - mine);
  wire_->changed.wait_for(lock, std::chrono::duration<double>(timeout_s),
                          [&] { return !waiting.empty() || !far_end_present; });
  if (waiting.empty() && !far_end_present) return gone();
  const std::size_t count = std::min(buffer.size(), waiting.size());
  const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(waiting.begin(), end, buffer.begin());
  waiting.erase(waiting.begin(), end);
  wire_->changed.notify_all();
  return count;
}

Result<void> PipePort::write(std::span<const std::byte> bytes, double timeout_s) {
  const auto theirs = static_cast<std::size_t>(1 - side_);
  std::unique_lock lock(wire_->mutex);
  auto& waiting = wire_->waiting.at(theirs);
  const bool& far_end_present = wire_->present.at(theirs);
  const bool room = wire_->changed.wait_for(lock, std::chrono::duration<double>(timeout_s), [&] {
    return waiting.size() + bytes.size() <= kCapacity || !far_end_present;
  });
  if (!far_end_present) return gone();
  if (!room) {
    return Error{Error::Code::kTimeout, "Nothing at the far end of " + wire_->name + " reads.", ""};
  }
  waiting.insert(waiting.end(), bytes.begin(), bytes.end());
  wire_->changed.notify_all();
  return {};
}

}  // namespace gyre
