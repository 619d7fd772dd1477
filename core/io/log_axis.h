// A logarithmic axis of a drawing: from numbers to places, and the numbers that are marked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace gyre {

class LogAxis {
 public:
  // Numbers from least to most (both > 0) come to lie between these two places; when they are
  // equal, in their middle.
  LogAxis(double least, double most, double from_place, double to_place);

  double placeOf(double number) const;

  // 1, 2 and 5 times the powers of ten within the axis; over more than three decades the powers of
  // ten alone.
  std::vector<double> marks() const;

 private:
  double least_;
  double most_;
  double from_;
  double to_;
};

}  // namespace gyre
