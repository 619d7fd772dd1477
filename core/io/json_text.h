// What the JSON files have in common: numbers that survive, and sentences for what does not parse.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace gyre {

// Fails with the line at which the text stops being JSON; names NaN and Infinity, which JSON does
// not know. file: what the sentence calls it.
Result<void> checkJson(std::string_view text, const std::string& file);

// The shortest text from which exactly this number is read again. "nan" or "inf", which no reader
// takes, when it is not finite.
std::string jsonNumber(double value);

// The text in quotation marks, with all escapes; bytes that are not UTF-8 are replaced.
std::string jsonString(std::string_view text);

}  // namespace gyre
