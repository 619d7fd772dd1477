// Whether a calibration target can be what it says it is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/scan/target.h"

namespace gyre {

// What is wrong with the target, as the rest of a sentence that begins with its name ("has no
// points"), or nothing when all is well. All numbers must be finite.
std::optional<std::string> faultOf(const Target& target);

}  // namespace gyre
