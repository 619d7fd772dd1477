// The $ settings of the simulated board, as its EEPROM keeps them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace gyre {

// The motor on the X axis and what is set up in the board's memory. Degrees: the wire's own unit.
struct TurntableFirmwareOptions {
  double steps_per_turn = 3200.0;          // 200 full steps in sixteenths; > 0
  double units_per_turn = 360.0;           // X counts degrees; > 0
  double max_speed_deg_per_s = 60.0;       // $110; > 0
  double acceleration_deg_per_s2 = 120.0;  // $120; > 0
  bool homing = false;                     // $22: the board is locked after each start
  double boot_time_s = 0.4;                // from reset to banner, simulated; >= 0
};

class GrblSettings {
 public:
  static constexpr int kIdleDelay = 1;
  static constexpr int kInvertDirection = 3;
  static constexpr int kReportMask = 10;
  static constexpr int kReportInches = 13;
  static constexpr int kSoftLimits = 20;
  static constexpr int kHardLimits = 21;
  static constexpr int kHoming = 22;
  static constexpr int kStepsPerUnit = 100;
  static constexpr int kMaxRate = 110;
  static constexpr int kAcceleration = 120;
  static constexpr int kMaxTravel = 130;

  explicit GrblSettings(const TurntableFirmwareOptions& options);

  double value(int number) const { return values_.at(number); }
  // Obeys "$N=x". Returns GRBL's error number, 0 for none.
  int assign(std::string_view line);
  // "$0=10" and so on, a line each.
  std::string report() const;

 private:
  std::map<int, double> values_;
};

// A number with so many decimals, as the firmware prints it.
std::string fixedText(double value, int decimals);

}  // namespace gyre
