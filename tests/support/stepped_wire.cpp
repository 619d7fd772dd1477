// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/stepped_wire.h"

#include <algorithm>
#include <utility>

namespace gyre::test {
namespace {

constexpr double kStep_s = 0.002;

Error gone() { return {Error::Code::kGone, "The cable was pulled.", ""}; }

}  // namespace

class SteppedRoom::Port final : public BytePort {
 public:
  Port(SteppedRoom& room, std::string name)
      : room_(room), name_(std::move(name)), mine_(room.plugged_) {}

  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override {
    const double end_s = room_.time_s_ + timeout_s;
    for (;;) {
      if (mine_ != room_.plugged_) return gone();
      if (!room_.unread_.empty()) break;
      if (room_.time_s_ >= end_s) return std::size_t{0};
      room_.step();
    }
    const std::size_t count = std::min(buffer.size(), room_.unread_.size());
    std::transform(room_.unread_.begin(),
                   room_.unread_.begin() + static_cast<std::ptrdiff_t>(count), buffer.begin(),
                   [](char c) { return static_cast<std::byte>(c); });
    room_.unread_.erase(0, count);
    return count;
  }

  Result<void> write(std::span<const std::byte> bytes, double) override {
    if (mine_ != room_.plugged_) return gone();
    for (const std::byte byte : bytes) room_.sent_ += static_cast<char>(byte);
    room_.board_->receive(bytes, room_.time_s_);
    return {};
  }

  double seconds() const override { return room_.time_s_; }
  std::string name() const override { return name_; }

 private:
  SteppedRoom& room_;
  std::string name_;
  int mine_;
};

std::unique_ptr<BytePort> SteppedRoom::openPort(const std::string& name) {
  ++plugged_;
  unread_.clear();
  board_->reset(time_s_);
  board_->takeOutput();
  return std::make_unique<Port>(*this, name);
}

void SteppedRoom::step() {
  time_s_ += kStep_s;
  board_->advanceTo(time_s_);
  for (std::size_t i = 0; i < happenings_.size(); ++i) {
    if (happenings_[i].time_s > time_s_) continue;
    const auto what = std::move(happenings_[i].what);
    happenings_.erase(happenings_.begin() + static_cast<std::ptrdiff_t>(i--));
    what();
  }
  unread_ += board_->takeOutput();
}

void SteppedRoom::pass(double seconds) {
  const double end_s = time_s_ + seconds;
  while (time_s_ < end_s) step();
}

}  // namespace gyre::test
