// Whether the views of a turn fall on whole motor steps, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace gyre {

// A sentence when one turn is no whole number of steps between so many views: by how much steps
// differ, and which numbers of views nearby come out even. Empty when all is even. The angles that
// are recorded are those of the steps made, so that it costs no accuracy.
// steps_per_turn > 0, views > 0.
std::string viewStepsRemark(double steps_per_turn, int views);

}  // namespace gyre
