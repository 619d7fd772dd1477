// Asks the person at the terminal to turn a table that has no motor.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/console.h"
#include "core/device/hand_turntable.h"

namespace gyre {

// Says what to do and waits for the Enter key on the file descriptor `keys`, standard input by
// default. The end of the input fails with kGone: nobody is there. The console must outlive it.
AskPerson askAtTerminal(Console& console, int keys = 0);

}  // namespace gyre
