// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/view_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr std::size_t kSuggestions = 3;

// Numbers of views around this one into which the steps divide evenly, nearest first.
std::vector<int> evenViews(long long steps, int views) {
  std::vector<int> even;
  for (int count = std::max(2, views / 2); count <= 2 * views; ++count) {
    if (steps % count == 0) even.push_back(count);
  }
  std::sort(even.begin(), even.end(),
            [views](int a, int b) { return std::abs(a - views) < std::abs(b - views); });
  even.resize(std::min(even.size(), kSuggestions));
  std::sort(even.begin(), even.end());
  return even;
}

}  // namespace

std::string viewStepsRemark(double steps_per_turn, int views) {
  const double whole = std::round(steps_per_turn);
  if (std::abs(steps_per_turn - whole) > 1e-6) {
    return formatted(
        "One turn is %.2f motor steps, not a whole number: the table ends its turn up "
        "to %.3f\u00b0 beside its start, and the angles that are recorded say so.",
        steps_per_turn, 180.0 / steps_per_turn);
  }
  const auto steps = static_cast<long long>(whole);
  if (steps % views == 0) return {};
  std::string remark = formatted(
      "%lld motor steps of a turn do not divide evenly into %d views: steps between views "
      "differ by one (%.3f\u00b0), and the angles that are recorded say so.",
      steps, views, 360.0 / whole);
  const std::vector<int> even = evenViews(steps, views);
  if (even.empty()) return remark;
  remark += " Even are";
  for (std::size_t i = 0; i < even.size(); ++i) {
    remark += i == 0 ? " " : i + 1 == even.size() ? " or " : ", ";
    remark += std::to_string(even[i]);
  }
  return remark + " views.";
}

}  // namespace gyre
