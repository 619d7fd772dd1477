// The words that demo, scan and resume share: the simulated rig and the real one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "app/cli/ask_person.h"
#include "app/rig.h"
#include "core/base/result.h"

namespace CLI {
class App;
}

namespace gyre {

// Changes to the simulated rig, as they stand on the command line.
struct SimWords {
  std::string rig_file;  // --rig
  int seed = -1;         // --seed; -1: the rig's own
  bool glossy = false;   // --glossy
  double speed = 10.0;   // --sim-speed
};

void addSimWords(CLI::App& command, SimWords& words);

// --unlock, where a turntable is opened.
void addUnlockWord(CLI::App& command, bool& unlock);
UnlockWord unlockWord(bool unlock);

// The settings that the words ask for, on top of the default rig. object: empty for the rig's own.
Result<RigSettings> simulatedRig(const SimWords& words, const std::string& object);

}  // namespace gyre
