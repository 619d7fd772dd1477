// Asks the person at the terminal to turn a table by hand, or whether a board may be unlocked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "app/cli/console.h"
#include "core/device/hand_turntable.h"
#include "core/device/turntable.h"
#include "core/device/watched_turntable.h"

namespace gyre {

// Says what to do and waits for the Enter key on the file descriptor `keys`, standard input by
// default. The end of the input fails with kGone: nobody is there. The console must outlive it.
AskPerson askAtTerminal(Console& console, int keys = 0);

// Says how far a table that is turned freely is still to be turned. The console must outlive it.
TellPerson tellAtTerminal(Console& console);

// What the command line says of locks: nothing, or --unlock.
enum class UnlockWord : std::uint8_t { kAsk, kGiven };

// Sees to it that a board which is locked may be unlocked by the table's first move: by the word,
// or by the answer at a terminal. kNoPermission, with the reason and what to do, when neither
// allows it; the board is then sent nothing. A board that is not locked is left alone, and nobody
// is asked.
Result<void> allowUnlock(Turntable& table, UnlockWord word, Console& console, const Task& task,
                         int keys = 0);

}  // namespace gyre
