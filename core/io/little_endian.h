// Numbers as bytes, lowest first, on any machine.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace gyre {

template <class Number>
void appendLittleEndian(std::string& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

// The number at these sizeof(Number) bytes.
template <class Number>
Number littleEndianAt(const char* bytes) {
  std::array<char, sizeof(Number)> raw{};
  std::copy_n(bytes, raw.size(), raw.begin());
  if (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

}  // namespace gyre
