// How a wait in a driver hears that it shall end.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace gyre {

// Asked at least every 20 ms while waiting; true ends the wait with kCancelled.
using Interrupted = std::function<bool()>;

}  // namespace gyre
