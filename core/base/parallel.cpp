// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/parallel.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

#include "core/base/check.h"

namespace gyre {

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
  GYRE_CHECK(grain > 0);
  const std::size_t chunks = (count + grain - 1) / grain;
  oneapi::tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
  });
}

}  // namespace gyre
