// A controller board with GRBL 1.1 on it that turns a table: the firmware without thread or wire.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/sim/firmware_board.h"
#include "core/sim/gcode.h"
#include "core/sim/grbl_settings.h"
#include "core/sim/shaft.h"
#include "core/sim/stepper_motion.h"

namespace gyre {

// Only X is wired to a motor; Y and Z arrive at once.
//
// Source: grbl/doc/markdown/{interface,commands,settings,jogging}.md, version 1.1h.
class GrblBoard final : public FirmwareBoard {
 public:
  GrblBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft);

  void reset(double time_s) override;
  void receive(std::span<const std::byte> bytes, double time_s) override;
  void advanceTo(double time_s) override;
  void pressLimitSwitch(double time_s) override;  // ALARM:1 when $21 is set
  std::string takeOutput() override;
  bool busy() const override;

 private:
  // A line that was read but cannot be answered yet.
  struct Pending {
    GcodeCommand command;
    bool jog = false;
    std::optional<double> until_s;  // a dwell that has begun
  };

  void hear(char c, double time_s);
  void softReset(double time_s);
  void boot();
  void work(double time_s);
  void settle(double time_s);
  bool finish(Pending& pending, double time_s);
  void obey(std::string_view line);
  int obeySystem(std::string_view line);
  int assign(std::string_view line);
  int take(int error, const GcodeCommand& command, bool jog);
  bool outOfTravel(const GcodeCommand& command) const;
  void plan(const GcodeCommand& command, bool jog, double time_s);
  void raiseAlarm(int number);
  void stopDead();
  void turnShaft();
  void readPositionBack();
  void say(std::string_view line) { output_.append(line).append("\r\n"); }
  std::string_view stateName() const;
  bool inMotion() const { return motion_.moving() || !motion_.empty(); }
  double unitsOf(std::int64_t steps) const;
  double setting(int number) const { return settings_.value(number); }
  // Of the shaft, for a step that the board counts up.
  std::int64_t sign() const { return setting(GrblSettings::kInvertDirection) != 0.0 ? -1 : 1; }
  std::string statusReport();

  TurntableFirmwareOptions options_;
  std::shared_ptr<Shaft> shaft_;
  GrblSettings settings_;  // survive a reset, as in EEPROM
  StepperMotion motion_;
  GcodeState gcode_;
  std::int64_t shaft_at_zero_ = 0;  // the shaft when the board counts 0
  std::string received_;            // realtime characters already taken out
  std::string output_;
  std::optional<Pending> pending_;
  std::optional<double> boots_at_s_;
  bool jogging_ = false;
  bool cancelling_jog_ = false;
  bool alarm_ = false;
  bool needs_reset_ = false;  // after a limit alarm nothing but 0x18 is heard
  bool asleep_ = false;
  int reports_ = 0;
};

}  // namespace gyre
