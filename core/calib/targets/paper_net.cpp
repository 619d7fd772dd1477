// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/paper_net.h"

#include <cmath>

#include "core/base/units.h"

namespace gyre {

using Eigen::Vector2d;
using Kind = PrintLine::Kind;

void cutLine(const Vector2d& from, const Vector2d& to, PrintDrawing& net) {
  net.lines.push_back({Kind::kCut, from, to});
}

void foldLine(const Vector2d& from, const Vector2d& to, PrintDrawing& net) {
  net.lines.push_back({Kind::kFold, from, to});
}

void cutCircle(const Vector2d& centre, double radius_mm, PrintDrawing& net) {
  constexpr int kSides = 180;
  const auto at = [&](int i) -> Vector2d {
    const double angle_rad = kTurn_rad * i / kSides;
    return centre + radius_mm * Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  };
  for (int i = 0; i < kSides; ++i) cutLine(at(i), at(i + 1), net);
}

void flap(const Vector2d& from, const Vector2d& to, double depth_mm, PrintDrawing& net) {
  const Vector2d along = (to - from).normalized();
  const Vector2d outward = depth_mm * Vector2d(along.y(), -along.x());  // y runs down the page
  const Vector2d slant = 0.8 * depth_mm * along;
  foldLine(from, to, net);
  const Vector2d outer_from = from + outward + slant;
  const Vector2d outer_to = to + outward - slant;
  net.lines.push_back({Kind::kFlap, from, outer_from});
  net.lines.push_back({Kind::kFlap, outer_from, outer_to});
  net.lines.push_back({Kind::kFlap, outer_to, to});
  constexpr double kWordWidth_mm = 12.0;
  constexpr double kWordHeight_mm = 4.0;
  const Vector2d size(kWordWidth_mm, kWordHeight_mm);
  net.texts.push_back({0.5 * (from + to) + 0.5 * outward - 0.5 * size, size, "glue",
                       PrintText::Style::kSmall, PrintText::Align::kCentre});
}

void label(const Vector2d& centre, const std::string& words, PrintDrawing& net) {
  constexpr double kWidth_mm = 46.0;
  constexpr double kHeight_mm = 12.0;
  const Vector2d size(kWidth_mm, kHeight_mm);
  net.texts.push_back(
      {centre - 0.5 * size, size, words, PrintText::Style::kPlain, PrintText::Align::kCentre});
}

}  // namespace gyre
