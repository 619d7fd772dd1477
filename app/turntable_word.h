// What people call a turntable by: "/dev/ttyUSB0", "marlin:/dev/ttyUSB0", "hand:36".
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace gyre {

struct TurntableWord {
  std::string firmware;               // of firmwareWords(); empty: to be found out
  std::filesystem::path description;  // of a table of one's own; empty: none
  std::string port;                   // "/dev/ttyUSB0" or "tcp:HOST:PORT"; empty: by hand
  int marks = 0;                      // by hand: on the rim; 0 when it is not said
  bool isNetwork() const { return port.starts_with("tcp:"); }
};

// [FIRMWARE:|FILE.json:]PORT, hand[:MARKS] or hand:free. kInvalidInput for what is neither; whether
// the port is there is found out when it is opened.
Result<TurntableWord> turntableWord(const std::string& word);

// The same word, with a port's stable name in place of the one that changes with the socket, and a
// file's whole path: what is kept with a scan that may be resumed. Words that are none, and those
// of simulations, come back as they are.
std::string lastingTurntableWord(const std::string& word);

}  // namespace gyre
