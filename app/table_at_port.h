// Finds the turntable at a port, serial or on the network, and keeps what passes over its wire.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "app/turntable_word.h"
#include "core/base/task.h"
#include "core/device/find_table.h"

namespace gyre {

// Opens the port, at the speeds at which such a board may be set up, and identifies what is there;
// moves nothing. A wire that cannot be logged is used all the same.
TableSearch searchAtPort(const TurntableWord& word, double greeting_s, const Task& task);

// Where the wire of this port is logged: in the user's cache. A port has one user at a time.
std::filesystem::path wireLogFile(const std::string& port);

}  // namespace gyre
