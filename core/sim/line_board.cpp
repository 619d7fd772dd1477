// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/line_board.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace gyre {
namespace {

constexpr std::size_t kReceiveBuffer_bytes = 128;
constexpr double kReminder_s = 2.0;

}  // namespace

LineBoard::LineBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft)
    : options_(options),
      shaft_(std::move(shaft)),
      speed_steps_per_s_(options.max_speed_deg_per_s / 360.0 * options.steps_per_turn),
      shaft_at_zero_(shaft_->steps()) {}

void LineBoard::reset(double time_s) {
  advanceTo(time_s);
  stopDead();
  shaft_at_zero_ = shaft_->steps();
  motion_.setSteps(0);
  planned_ = 0;
  received_.clear();
  at_standstill_.reset();
  occupied_until_s_ = 0.0;
  speed_steps_per_s_ = options_.max_speed_deg_per_s / 360.0 * options_.steps_per_turn;
  boots_at_s_ = time_s + options_.boot_time_s;
}

void LineBoard::boot() {
  boots_at_s_.reset();
  restart();
}

void LineBoard::restart() {
  received_.clear();
  at_standstill_.reset();
  restarted();
  if (!greeting().empty()) say(greeting());
}

void LineBoard::stopDead() {
  motion_.stopDead();
  at_standstill_.reset();
  planned_ = motion_.steps();
  turnShaft();
}

void LineBoard::turnShaft() {
  if (!motor_on_) shaft_at_zero_ = shaft_->steps() - motion_.steps();
  shaft_->setSteps(shaft_at_zero_ + motion_.steps());
}

std::string LineBoard::takeOutput() { return std::exchange(output_, {}); }

bool LineBoard::busy() const {
  return boots_at_s_ || at_standstill_ || motion_.moving() || occupied_until_s_ > time_s_;
}

void LineBoard::occupy(double seconds, double time_s) {
  advanceTo(time_s);
  occupied_until_s_ = time_s + seconds;
  reminded_s_ = time_s;
}

bool LineBoard::turnBy(std::int64_t steps) {
  if (motion_.full()) return false;
  planned_ += steps;
  motion_.add({planned_, speed_steps_per_s_,
               options_.acceleration_deg_per_s2 / 360.0 * options_.steps_per_turn},
              time_s_);
  return true;
}

void LineBoard::advanceTo(double time_s) {
  time_s_ = std::max(time_s_, time_s);
  if (boots_at_s_) {
    if (time_s_ < *boots_at_s_) return;
    boot();
  }
  motion_.advanceTo(time_s_, [this](std::int64_t steps) {
    if (motor_on_) shaft_->setSteps(shaft_at_zero_ + steps);
  });
  turnShaft();
  work();
}

void LineBoard::receive(std::span<const std::byte> bytes, double time_s) {
  advanceTo(time_s);
  if (boots_at_s_) return;  // what comes now is lost
  for (const std::byte byte : bytes) {
    const char c = static_cast<char>(byte);
    if (hearAtOnce(c) || received_.size() >= kReceiveBuffer_bytes) continue;
    received_ += c;
    if (lineEnds().find(c) != std::string_view::npos) work();
  }
}

// Obeys lines one after the other until one has to wait.
void LineBoard::work() {
  for (;;) {
    const bool occupied = occupied_until_s_ > time_s_;
    if (occupied || (at_standstill_ && moving())) {
      if (time_s_ >= reminded_s_ + kReminder_s) {
        reminded_s_ = time_s_;
        remindOfBeingBusy();
      }
      return;
    }
    if (at_standstill_) {
      const std::string line = *std::exchange(at_standstill_, std::nullopt);
      if (!line.empty()) say(line);
    }
    const std::size_t end = received_.find_first_of(lineEnds());
    if (end == std::string::npos) return;
    const std::string line = received_.substr(0, end);
    received_.erase(0, end + 1);
    if (line.empty() && !hasEmptyLines()) continue;
    reminded_s_ = time_s_;
    obey(line);
  }
}

}  // namespace gyre
