// The boards that the simulation has, by name.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/sim/firmware_board.h"
#include "core/sim/grbl_settings.h"
#include "core/sim/shaft.h"

namespace gyre {

// "grbl", "marlin" and so on.
std::vector<std::string> firmwareBoardNames();

// Null for another name.
std::unique_ptr<FirmwareBoard> makeFirmwareBoard(const std::string& name,
                                                 const TurntableFirmwareOptions& options,
                                                 std::shared_ptr<Shaft> shaft);

}  // namespace gyre
