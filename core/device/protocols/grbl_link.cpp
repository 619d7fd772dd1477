// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/grbl_link.h"

#include <array>
#include <span>

namespace gyre {
namespace {

constexpr double kSlice_s = 0.02;
constexpr double kWriteTimeout_s = 1.0;
constexpr double kQuiet_s = 0.05;
constexpr double kLongestDrain_s = 0.5;
constexpr std::size_t kGarbageKept = 200;
constexpr int kHardLimit = 1;  // alarms
constexpr int kSoftLimit = 2;

}  // namespace

Result<void> GrblLink::send(std::string_view text) {
  return port_->write(std::as_bytes(std::span(text)), kWriteTimeout_s);
}

Result<std::optional<GrblMessage>> GrblLink::receive(double timeout_s) {
  const double deadline_s = now() + timeout_s;
  for (;;) {
    if (std::optional<GrblMessage> message = parser_.next()) {
      note(*message);
      return message;
    }
    const double left_s = deadline_s - now();
    if (left_s <= 0.0) return std::optional<GrblMessage>();
    std::array<std::byte, 256> buffer{};
    const Result<std::size_t> count = port_->read(buffer, left_s);
    if (!count) return count.error();
    parser_.feed(std::span(buffer).first(*count));
  }
}

// Keeps what must not be overlooked, whoever reads the message.
void GrblLink::note(GrblMessage& message) {
  using Kind = GrblMessage::Kind;
  if (message.kind == Kind::kBanner) {
    needs_reset_ = false;
    if (trouble_) return;  // an alarm before it says more
    trouble_ = Error{Error::Code::kAlarm, "The turntable's board has restarted.",
                     "Check its power and its cable."};
  } else if (message.kind == Kind::kAlarm) {
    ++alarms_;
    needs_reset_ = message.number == kHardLimit || message.number == kSoftLimit;
    trouble_ = Error{Error::Code::kAlarm,
                     "The turntable has stopped by itself (" + grblAlarmText(message.number) + ").",
                     "Remove the cause, then set the angle anew."};
  } else if (message.kind == Kind::kGarbage) {
    garbage_ += (garbage_.empty() ? "" : " ") + message.text;
    if (garbage_.size() > kGarbageKept) garbage_.erase(0, garbage_.size() - kGarbageKept);
  } else if (message.kind == Kind::kStatus) {
    completePosition(message.status);
  }
}

void GrblLink::completePosition(GrblStatus& status) {
  for (auto* position : {&status.machine, &status.work, &status.work_offset}) {
    for (double& value : *position) value *= report_scale_;
  }
  if (!status.work_offset.empty()) work_offset_ = status.work_offset;
  if (!status.machine.empty() || work_offset_.size() < status.work.size()) return;
  for (std::size_t i = 0; i < status.work.size(); ++i) {
    status.machine.push_back(status.work[i] + work_offset_[i]);
  }
}

Error GrblLink::silence() const {
  return {Error::Code::kTimeout, "The turntable on " + name() + " does not answer.",
          "Check its power and its cable, then connect again."};
}

Result<void> GrblLink::drain() {
  const double end_s = now() + kLongestDrain_s;
  while (now() < end_s) {
    const Result<std::optional<GrblMessage>> message = receive(kQuiet_s);
    if (!message) return message.error();
    if (!*message) return {};
  }
  return {};
}

Result<std::vector<GrblMessage>> GrblLink::query(std::string_view line, double timeout_s,
                                                 const Interrupted& interrupted) {
  if (trouble_) return *trouble_;
  if (const Result<void> sent = send(std::string(line) + "\n"); !sent) return sent.error();
  std::vector<GrblMessage> said;
  const double deadline_s = now() + timeout_s;
  while (now() < deadline_s) {
    if (interrupted && interrupted()) return cancelled();
    Result<std::optional<GrblMessage>> message = receive(kSlice_s);
    if (!message) return message.error();
    if (trouble_) return *trouble_;
    if (!*message) continue;
    if ((*message)->kind == GrblMessage::Kind::kOk) return said;
    if ((*message)->kind == GrblMessage::Kind::kError) {
      return Error{Error::Code::kRejected,
                   "The turntable refuses to obey (" + grblErrorText((*message)->number) + ").",
                   "Connect again, and look at the firmware's settings."};
    }
    said.push_back(**std::move(message));
  }
  return silence();
}

Result<void> GrblLink::command(std::string_view line, double timeout_s,
                               const Interrupted& interrupted) {
  const Result<std::vector<GrblMessage>> said = query(line, timeout_s, interrupted);
  if (!said) return said.error();
  return {};
}

Result<GrblStatus> GrblLink::status(double timeout_s, const Interrupted& interrupted) {
  if (trouble_) return *trouble_;
  const double begin_s = now();
  double ask_s = begin_s;
  while (now() < begin_s + timeout_s) {
    if (interrupted && interrupted()) return cancelled();
    if (now() >= ask_s) {
      ask_s = now() + timeout_s / 4.0;
      if (const Result<void> sent = send(std::string_view(&kGrblStatusRequest, 1)); !sent) {
        return sent.error();
      }
    }
    Result<std::optional<GrblMessage>> message = receive(kSlice_s);
    if (!message) return message.error();
    if (trouble_) return *trouble_;
    if (*message && (*message)->kind == GrblMessage::Kind::kStatus &&
        !(*message)->status.machine.empty()) {
      return (**std::move(message)).status;
    }
  }
  return silence();
}

}  // namespace gyre
