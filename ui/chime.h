// Short signals for moments at which nobody may be looking at the screen.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

// Told apart by how often they sound.
enum class Chime {
  kDone = 1,    // a job has ended well
  kPlace = 2,   // something is to be put on the table
  kPaused = 3,  // the table stands and waits
};

// Sounds by the desktop's own bell, which users can change or mute. Returns at once. GUI thread.
void sound(Chime chime);

}  // namespace gyre
