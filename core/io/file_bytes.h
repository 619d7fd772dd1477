// Reads whole files, and says in words why a file could not be read or written.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace gyre {

// The file's bytes. Fails when it is no regular file, cannot be read or holds more than max_bytes.
Result<std::string> readFileBytes(const std::filesystem::path& file, std::uintmax_t max_bytes);

// Whether there is anything of that name; false where it cannot be told.
bool isThere(const std::filesystem::path& file);

// What a failed system call on a file means to the user. doing: "read", "write", "create".
Error fileError(int error_number, const std::string& doing, const std::filesystem::path& file);

}  // namespace gyre
