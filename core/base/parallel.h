// Spreads independent work over the cores.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace gyre {

// Calls body(begin, end) on ranges that together cover [0, count), in any order and on any thread.
// The split depends on count and grain only, so per-range results do not depend on the number of
// threads. Returns when all are done; an exception of the body is rethrown here.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace gyre
