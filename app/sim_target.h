// The calibration target on the simulated table: from a file or a name to what is rendered.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/scan/target.h"
#include "core/sim/printed_target.h"
#include "core/sim/rig.h"

namespace gyre {

// The target of that name among those that can be printed, else that of the file TARGET.json.
Result<Target> findTarget(const std::string& name_or_file);

// Sets what stands on the simulated table from the word of an object: a name, or
// "target[:NAME_OR_FILE]" for a calibration target. A file's path is made absolute, so that the
// rig's record finds it from anywhere. An empty word changes nothing.
void placeObject(const std::string& word, RigSettings& rig);

// What the settings' target looks like; null when they name none. The wedge when the object is a
// target that is not named.
Result<std::shared_ptr<const PrintedTarget>> simulatedTarget(const RigSettings& rig);

}  // namespace gyre
