// Reads how to speak to a turntable whose firmware Gyre does not know.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/turntable_description.h"

namespace gyre {

// Fails with a sentence on a description that cannot be used: no name, nothing by which the table
// can be told from others, no way to turn it or to know that it stands, impossible numbers, a key
// that means nothing (most likely misspelt), or words that home an axis or heat. What the keys
// mean: docs/user/turntables.md.
Result<TurntableDescription> readTurntableDescription(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<TurntableDescription> parseTurntableDescription(std::string_view text,
                                                       const std::string& file);

}  // namespace gyre
