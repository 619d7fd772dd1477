// The clock by which frames and motions are ordered.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

// Seconds on a clock that never jumps; only differences mean anything. Any thread.
double steadySeconds();

}  // namespace gyre
