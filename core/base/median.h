// The middle of many numbers.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/check.h"

namespace gyre {

// The value that share of the others lie below: 0.5 is the median, the upper one of an even number.
// values: not empty, none of them NaN. share in [0, 1]. Linear time.
template <class Number>
Number quantile(std::vector<Number> values, double share) {
  GYRE_CHECK(!values.empty());
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = static_cast<std::ptrdiff_t>(std::lround(share * last));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

template <class Number>
Number median(std::vector<Number> values) {
  return quantile(std::move(values), 0.5);
}

}  // namespace gyre
