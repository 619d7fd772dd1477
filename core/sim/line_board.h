// What simulated boards have in common that are spoken to in lines and turn one motor.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/sim/firmware_board.h"
#include "core/sim/grbl_settings.h"
#include "core/sim/shaft.h"
#include "core/sim/stepper_motion.h"

namespace gyre {

// Lines are obeyed one after the other; a line that has to wait keeps the next ones waiting, in a
// receive buffer of 128 bytes. What does not fit is lost, as on the real boards.
class LineBoard : public FirmwareBoard {
 public:
  LineBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft);

  void reset(double time_s) final;
  void receive(std::span<const std::byte> bytes, double time_s) final;
  void advanceTo(double time_s) final;
  void pressLimitSwitch(double) override {}  // none is wired
  std::string takeOutput() final;
  bool busy() const final;

  // The board does something else for so long: heats, or waits for a key. It obeys nothing.
  void occupy(double seconds, double time_s);

 protected:
  // ---- what each firmware's file gives
  virtual std::string greeting() const { return {}; }
  virtual void restarted() {}  // forgets what memory forgets
  virtual void obey(std::string_view line) = 0;
  // Obeyed wherever it stands in the stream; true when it is no part of a line.
  virtual bool hearAtOnce(char) { return false; }
  virtual std::string_view lineEnds() const { return "\r\n"; }
  virtual std::string_view answerEnd() const { return "\r\n"; }
  virtual bool hasEmptyLines() const { return false; }  // an empty line is obeyed too
  virtual void remindOfBeingBusy() {}                   // every two seconds while a line waits

  // ---- what it has for it
  void say(std::string_view line) { output_.append(line).append(answerEnd()); }
  void sayRaw(std::string_view bytes) { output_.append(bytes); }
  // Plans a motion by so many motor steps; false when the planner is full.
  bool turnBy(std::int64_t steps);
  // The line being obeyed is finished once the motor stands: then this is said.
  void finishAtStandstill(std::string line) { at_standstill_ = std::move(line); }
  void finishSilently() { at_standstill_ = std::string(); }
  std::int64_t planned() const { return planned_; }  // where the motor will be, from its start
  std::int64_t counted() const { return motion_.steps(); }
  void stopDead();  // and forgets what it waited for
  // A motor that is off counts its steps but turns nothing.
  void switchMotorOn() { motor_on_ = true; }
  void switchMotorOff() { motor_on_ = false; }
  void restart();  // by the host's own word: at once, the count stays
  bool moving() const { return motion_.moving() || !motion_.empty(); }
  double stepsPerTurn() const { return options_.steps_per_turn; }
  void setSpeed(double steps_per_s) { speed_steps_per_s_ = steps_per_s; }
  double now() const { return time_s_; }

 private:
  void boot();
  void work();
  void turnShaft();

  TurntableFirmwareOptions options_;
  std::shared_ptr<Shaft> shaft_;
  StepperMotion motion_;
  double speed_steps_per_s_;
  std::int64_t shaft_at_zero_;
  std::int64_t planned_ = 0;
  std::string received_;
  std::string output_;
  std::optional<std::string> at_standstill_;
  std::optional<double> boots_at_s_;
  bool motor_on_ = true;
  double occupied_until_s_ = 0.0;
  double reminded_s_ = 0.0;
  double time_s_ = 0.0;
};

}  // namespace gyre
