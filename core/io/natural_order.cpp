// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/natural_order.h"

#include <algorithm>

namespace gyre {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Takes the run of digits off the front and returns it without its leading zeros.
std::string_view takeNumber(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), isDigit);
  std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

// Below, at or above zero as a comes before, with or after b, whatever their leading zeros.
int compareCounting(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (isDigit(a.front()) && isDigit(b.front())) {
      const std::string_view number_a = takeNumber(a);
      const std::string_view number_b = takeNumber(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size() ? -1 : 1;
      if (const int order = number_a.compare(number_b); order != 0) return order;
    } else {
      const auto byte_a = static_cast<unsigned char>(a.front());
      const auto byte_b = static_cast<unsigned char>(b.front());
      if (byte_a != byte_b) return byte_a < byte_b ? -1 : 1;
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.empty() ? (b.empty() ? 0 : -1) : 1;
}

}  // namespace

bool NaturalOrder::operator()(std::string_view a, std::string_view b) const {
  const int order = compareCounting(a, b);
  return order != 0 ? order < 0 : a < b;
}

}  // namespace gyre
