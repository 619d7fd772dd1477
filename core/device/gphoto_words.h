// What still cameras call things, read as text.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace gyre {

// ASCII letters only.
std::string lowerCase(std::string text);

// "IMG_0001.JPG" and the like.
bool namesJpeg(const std::string& file_name);

// "1/125" and "f/8" as 0.008 and 8; 0 for words.
double numberInWord(const std::string& word);

// "ptpip:HOST[:PORT]" as libgphoto2 has it: with the port of commands and the one of events.
std::string ptpIpPortFor(const std::string& word);

}  // namespace gyre
