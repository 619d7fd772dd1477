// What drivers have in common whose firmware obeys "turn by so much" and says when it has.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/device/protocols/line_link.h"
#include "core/device/table_driver.h"

namespace gyre {

// Such firmwares know no gentle stop: a way is made in bites of half a second, each with the
// firmware's own ramps, and a stop is obeyed at the end of the bite. Nothing is sent before the
// last bite's end was heard. When the port vanishes, the bite that is under way is the last motion.
class BiteDriver : public TableDriver {
 public:
  Result<void> identify(double greeting_s, const Interrupted& interrupted) final;
  Result<TableMotor> setUp(const TurntableOptions& options) final;
  Result<std::int64_t> place(const Interrupted& interrupted) final;
  Result<void> makeReady(std::int64_t expected, const Interrupted& interrupted) final;
  Result<std::int64_t> travel(std::span<const std::int64_t> places,
                              const Interrupted& interrupted) final;
  Result<std::optional<std::int64_t>> halt() final;
  Result<void> release() final;
  const std::optional<Error>& trouble() const final { return trouble_; }
  Result<bool> forgiveTrouble() final;
  std::string portName() const final { return link_.name(); }

 protected:
  // What a line from the firmware means.
  enum class Sign {
    kOther,    // for people, or the answer to a question
    kDone,     // the last command has been carried out, as the firmware understands that
    kBusy,     // not yet, but it lives
    kResend,   // it was not understood: say it again
    kRefused,  // it will not be carried out
    kAlarm,    // the board has stopped by itself
    kRestart,  // the board has (re)started
  };
  using IsAnswer = std::function<bool(std::string_view line)>;

  BiteDriver(std::unique_ptr<BytePort> port, LineFraming framing)
      : link_(std::move(port), std::move(framing)) {}

  // ---- what each firmware's file gives
  virtual Sign signOf(std::string_view line) const = 0;
  // Asks who is there, after `greeting`, which is what was said by itself and may be empty. Leaves
  // the table's count at 0 where the firmware has one. Moves nothing.
  virtual Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) = 0;
  // The motor by what introduce() learnt.
  virtual Result<TableMotor> motorFor(const TurntableOptions& options) const = 0;
  // What has to be said before each bite; moves nothing.
  virtual Result<void> prepare(std::int64_t /*from*/, const Interrupted&) { return {}; }
  // Makes the bite and returns when the firmware says that the table stands at its end. kRejected
  // only when nothing has moved.
  virtual Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) = 0;
  // An exchange that moves nothing and is answered when the table stands.
  virtual Result<void> settle(double timeout_s, const Interrupted& interrupted) = 0;
  // The most of the way that the firmware can be told at once; the sign is kept.
  virtual std::int64_t biteOf(std::int64_t way) const { return way; }
  // Switches the motor on where the table stands; before the first move, and again after the
  // motor was let go and after the board restarted, when its own count may have begun anew.
  virtual Result<void> energise(std::int64_t /*at*/, const Interrupted&) { return {}; }
  // kRejected when the firmware cannot.
  virtual Result<void> letGo();
  // The place by the firmware's own count; nothing when it does not tell.
  virtual Result<std::optional<std::int64_t>> askPlace(const Interrupted&) {
    return std::optional<std::int64_t>();
  }

  // ---- what it has for it
  // Sends a line and waits until it is carried out: kDone. A line that is not understood is said
  // again. While the firmware says that it is busy, the wait is prolonged, at most to two minutes.
  Result<void> obey(const std::string& line, double timeout_s, const Interrupted& interrupted);
  // The same for a line that does no harm twice and is carried out when all motion has ended: said
  // again when it is refused, which a spoilt line is. kIo when that does not help.
  Result<void> obeyBarrier(const std::string& line, double timeout_s,
                           const Interrupted& interrupted);
  // Asks up to three times, until an answer comes; kTimeout when none does.
  Result<std::string> ask(const std::string& line, const IsAnswer& is_answer, double timeout_s,
                          const Interrupted& interrupted);
  // Takes in what is said meanwhile.
  Result<void> listen(double seconds, const Interrupted& interrupted);
  // How a line goes onto the wire: with a number and a sum where the firmware checks them.
  virtual std::string wrapped(const std::string& line) { return line; }
  double biteDeadline_s(std::int64_t steps) const;
  // Other lines than signs that were heard since the last line was sent.
  const std::vector<std::string>& said() const { return said_; }
  const TurntableOptions& options() const { return options_; }
  const TableMotor& motor() const { return motor_; }
  LineLink& link() { return link_; }
  Error wrongDevice(const std::string& firmware) const;

  static constexpr double kReply_s = 1.5;  // an exchange that moves nothing

 private:
  Result<std::optional<std::string>> hear(double timeout_s);
  Result<std::string> awaitGreeting(double greeting_s, const Interrupted& interrupted);
  Result<void> awaitDone(const std::string& line, double timeout_s, const Interrupted& interrupted);
  Result<void> drain();
  double bite_s(std::int64_t steps) const;

  LineLink link_;
  TurntableOptions options_;
  TableMotor motor_;
  std::optional<Error> trouble_;
  std::vector<std::string> said_;
  std::int64_t place_ = 0;
  std::int64_t under_way_ = 0;  // the bite whose end has not been heard
  int unanswered_ = 0;          // lines sent whose end has not been heard
  bool energised_ = false;
};

// ---- words that several firmwares share

// The number after the last `mark` in the line, or nothing.
std::optional<double> numberAfter(std::string_view line, std::string_view mark);

// Units of one turn: what the options say, or `usual` where they leave it at 360 degrees for a
// firmware that counts something else.
double unitsPerTurn(const TurntableOptions& options, double usual);

// The motor of a firmware that counts motor steps: `told` a turn by its own word, or `usual` where
// it keeps silent, which is a hindrance until the options or a calibration know better.
TableMotor stepCountingMotor(std::string firmware, const TurntableOptions& options,
                             std::optional<double> told, double usual);

}  // namespace gyre
