// What a firmware does for a table, counted in whole motor steps: the part that differs from
// firmware to firmware.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/device/interrupted.h"
#include "core/device/options.h"

namespace gyre {

// The motor as the firmware tells it, or as it is taken to be.
struct TableMotor {
  std::string firmware;                 // "Grbl 1.1h", for people
  double units_per_turn = 360.0;        // what the firmware counts in one turn
  double steps_per_turn = 0.0;          // > 0
  double farthest_steps = 1e15;         // beyond this count the firmware loses precision
  std::vector<std::string> hindrances;  // what stands in the way of turning, a sentence each
};

// Places are motor steps by the firmware's own count and in its own direction. One thread at a
// time. Every call ends by a deadline of its own, also when the far end is silent; `interrupted`
// ends those waits that may be ended. Moves use no homing and no heater, write no setting, and
// unlock nothing without a person's word.
class TableDriver {
 public:
  virtual ~TableDriver() = default;

  // Finds out whether its firmware is at the far end, waiting so long for a greeting. Moves
  // nothing. kWrongDevice when another answers, kTimeout when nothing does, kBusy when it moves.
  virtual Result<void> identify(double greeting_s, const Interrupted& interrupted) = 0;

  // What the firmware's settings and the options mean together; used for moves from then on.
  // After identify(), any number of times; no exchange.
  virtual Result<TableMotor> setUp(const TurntableOptions& options) = 0;

  // Where the table stands. kBusy when it moves.
  virtual Result<std::int64_t> place(const Interrupted& interrupted) = 0;

  // Makes a table that stands at this place ready to move, its motor on. kAlarm when it stands
  // elsewhere by the firmware's count, or when trouble() tells why the count means nothing.
  // kNoPermission when lock() tells why; nothing but a question has then been sent.
  virtual Result<void> makeReady(std::int64_t expected, const Interrupted& interrupted) = 0;

  // Goes to the places in turn. Returns where it stands still at the end by the firmware's own
  // sign of arrival: the last of them, unless the table strayed.
  virtual Result<std::int64_t> travel(std::span<const std::int64_t> places,
                                      const Interrupted& interrupted) = 0;

  // After a failure or an interruption: brings the table to rest, so that nothing that was asked
  // for goes on. Returns the place, or nothing when it was lost. Fails when the table cannot be
  // told to stand.
  virtual Result<std::optional<std::int64_t>> halt() = 0;

  // Lets go of the motor and switches off lasers.
  virtual Result<void> release() = 0;

  // kAlarm once the board was heard to restart or to stop by itself, until forgiveTrouble().
  virtual const std::optional<Error>& trouble() const = 0;
  // Takes in what was said meanwhile and forgets all trouble; true when there was some.
  virtual Result<bool> forgiveTrouble() = 0;

  // Why the firmware refuses to move until it is unlocked, and nobody has allowed that:
  // kNoPermission. Nothing when it does not refuse, as far as the last exchange told, or has no
  // such lock.
  virtual std::optional<Error> lock() const { return std::nullopt; }
  // A person's word that makeReady() may unlock the board; void once it stops by itself again.
  virtual void allowUnlock() {}

  virtual std::string portName() const = 0;

 protected:
  TableDriver() = default;
  TableDriver(const TableDriver&) = default;
  TableDriver& operator=(const TableDriver&) = default;
};

}  // namespace gyre
