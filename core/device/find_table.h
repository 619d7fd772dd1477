// Finds out which turntable is at a port, in an order that moves nothing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/byte_port.h"
#include "core/device/table_driver.h"
#include "core/scan/port_diagnosis.h"

namespace gyre {

struct TableSearch {
  std::unique_ptr<TableDriver> driver;  // identified; null when no known firmware answers
  std::string firmware;                 // the driver's word: "grbl"
  int baud = 0;
  std::vector<TableAnswer> answers;
  std::optional<Error> error;  // why there is no driver
};

// Opens the port at a speed.
using PortOpener = std::function<Result<std::unique_ptr<BytePort>>(int baud)>;

// The words for the firmwares that are known: "grbl", "marlin" and so on.
std::vector<std::string> firmwareWords();
// The speeds at which such a board may be set up, the usual one first.
std::vector<int> usualBauds(std::string_view firmware);
// Null for another word.
std::unique_ptr<TableDriver> makeTableDriver(std::string_view firmware,
                                             std::unique_ptr<BytePort> port);

// Which firmware says this; empty when none that is known does.
std::string firmwareIn(std::string_view heard);

// At each speed: waits so long for a greeting, then asks what each firmware answers by its name, a
// machine that may be moving first. Ends at the first that is known, and at the first legible
// answer of one that is not. Nothing that is sent moves any of them. At most about 12 s a speed.
TableSearch findTable(const PortOpener& open, const std::vector<int>& bauds, double greeting_s,
                      const Task& task);

// A driver over a port.
using DriverMaker = std::function<std::unique_ptr<TableDriver>(std::unique_ptr<BytePort> port)>;

// The same for one firmware that is known by other means.
TableSearch findTable(const DriverMaker& make, const PortOpener& open,
                      const std::vector<int>& bauds, double greeting_s, const Task& task);
// The same for one that is named by its word.
TableSearch findTable(std::string_view firmware, const PortOpener& open,
                      const std::vector<int>& bauds, double greeting_s, const Task& task);

}  // namespace gyre
