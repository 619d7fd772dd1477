// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/log_axis.h"

#include <cmath>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr double kManyDecades = 3.0;
constexpr double kSlack = 1e-9;  // for marks that stand on the very end

}  // namespace

LogAxis::LogAxis(double least, double most, double from_place, double to_place)
    : least_(least), most_(most), from_(from_place), to_(to_place) {
  GYRE_CHECK(least > 0.0 && most >= least);
}

double LogAxis::placeOf(double number) const {
  const double range = std::log(most_ / least_);
  const double share = range > 0.0 ? std::log(number / least_) / range : 0.5;
  return from_ + share * (to_ - from_);
}

std::vector<double> LogAxis::marks() const {
  const bool coarse = std::log10(most_ / least_) > kManyDecades;
  std::vector<double> marks;
  for (int power = static_cast<int>(std::floor(std::log10(least_)));
       power <= static_cast<int>(std::ceil(std::log10(most_))); ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double mark = digit * std::pow(10.0, power);
      const bool within = mark >= least_ * (1.0 - kSlack) && mark <= most_ * (1.0 + kSlack);
      if (within && (digit == 1.0 || !coarse)) marks.push_back(mark);
    }
  }
  return marks;
}

}  // namespace gyre
