// The simulated rig as a JSON text, for `--rig rig.json` and for the record of a simulated scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/sim/rig.h"

namespace gyre {

// All settings, a key each: the option's name with underscores ("object_size", "k1").
std::string rigToJson(const RigSettings& rig);

// Reads what rigToJson writes; keys that are absent keep the values of `base`. Fails on a text that
// is no JSON object, an unknown key, a value of the wrong kind or out of range.
Result<RigSettings> rigFromJson(const std::string& text, const RigSettings& base = {});

}  // namespace gyre
