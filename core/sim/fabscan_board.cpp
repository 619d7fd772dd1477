// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/fabscan_board.h"

#include <cstdint>
#include <cstdlib>

namespace gyre {
namespace {

// The whole number after the letter where a word begins; what follows the digits is passed over.
int wordIn(const std::string& line, char letter, int otherwise) {
  for (std::size_t at = 0; at < line.size(); at = line.find(' ', at) + 1) {
    if (line[at] == letter) return static_cast<std::int16_t>(std::atoi(line.c_str() + at + 1));
    if (line.find(' ', at) == std::string::npos) break;
  }
  return otherwise;
}

}  // namespace

void FabScanBoard::obey(std::string_view heard) {
  std::string line(heard);
  while (!line.empty() && line.back() == '\r') line.pop_back();
  sayRaw(std::string(heard) + "\n");
  const int motion = wordIn(line, 'G', -1);
  if (motion >= 0 && motion <= 2) turnBy(wordIn(line, 'T', 0));
  switch (wordIn(line, 'M', -1)) {
    case 17:
      switchMotorOn();
      break;
    case 18:
      switchMotorOff();
      break;
    case 200:
      say("v.20170721");
      break;
    default:
      break;
  }
  finishAtStandstill(">");
}

}  // namespace gyre
