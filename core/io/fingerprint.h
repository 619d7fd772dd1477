// What identifies the bytes of files: SHA-256, as sha256sum prints it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

// SHA-256 of the file's bytes, 64 hexadecimal digits.
Result<std::string> fingerprintOf(const std::filesystem::path& file);

// One for all of them, in their order: what `sha256sum NAME... | sha256sum` prints in their folder.
// Reads on all cores; fails when one cannot be read, and when stopped.
Result<std::string> fingerprintOf(std::span<const std::filesystem::path> files, const Task& task);

}  // namespace gyre
