// What is the matter with ports: who answers at one, and what the others tell without being opened.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/turntable_word.h"
#include "core/base/task.h"
#include "core/device/turntable.h"
#include "core/scan/port_diagnosis.h"

namespace gyre {

// What answers at a port, and the table itself where it is one.
struct CheckedPort {
  PortDiagnosis diagnosis;
  std::unique_ptr<Turntable> table;
};

// Opens the port, asks who is there at all usual speeds, and moves nothing. The word names a port.
CheckedPort checkPort(const TurntableWord& word, const Task& task);

// The port of the word, asked like that; then all others and the adapters without a port, as they
// are without being opened. The word is what is chosen as a turntable: one that names no port, such
// as "sim:duck" or nothing, asks nobody. Any thread.
std::vector<PortDiagnosis> checkPorts(const std::string& word, const Task& task);

}  // namespace gyre
