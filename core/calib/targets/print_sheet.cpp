// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/print_sheet.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace gyre {
namespace {

using Eigen::Vector2d;
using Kind = PrintLine::Kind;
using Align = PrintText::Align;
using Style = PrintText::Style;

constexpr double kRim_mm = 10.0;
constexpr double kNetTop_mm = 28.0;
constexpr double kDownRulerX_mm = 11.0;
constexpr double kDownRulerY_mm = 62.0;
constexpr double kEndMark_mm = 5.0;  // half its length: long enough for a caliper's jaws
constexpr double kTick_mm = 1.5;

void addNet(const StandardTarget& target, const Vector2d& corner, PrintDrawing& sheet) {
  for (PrintPolygon polygon : target.net.polygons) {
    for (Vector2d& point : polygon.outline) point += corner;
    sheet.polygons.push_back(std::move(polygon));
  }
  for (const PrintLine& line : target.net.lines) {
    sheet.lines.push_back({line.kind, line.from + corner, line.to + corner});
  }
  for (PrintText text : target.net.texts) {
    text.top_left += corner;
    sheet.texts.push_back(std::move(text));
  }
}

// A line with a mark every centimetre and long ones at both ends.
void addRuler(const Vector2d& from, const Vector2d& direction, PrintDrawing& sheet) {
  const Vector2d across(-direction.y(), direction.x());
  const Vector2d to = from + kRuler_mm * direction;
  sheet.rulers.push_back({from, to});
  sheet.lines.push_back({Kind::kRuler, from, to});
  constexpr int kCentimetres = 10;
  for (int i = 0; i <= kCentimetres; ++i) {
    const Vector2d at = from + kRuler_mm * i / kCentimetres * direction;
    const Vector2d half = (i % kCentimetres == 0 ? kEndMark_mm : kTick_mm) * across;
    sheet.lines.push_back({Kind::kRuler, at - half, at + half});
  }
}

std::string numbered(const std::vector<std::string>& steps) {
  std::string text;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    text += (i == 0 ? "" : "\n") + std::to_string(i + 1) + ". " + steps[i];
  }
  return text;
}

}  // namespace

std::optional<PageSize> pageSize(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (lower == "a4") return kA4;
  if (lower == "letter") return kLetter;
  return std::nullopt;
}

PrintDrawing sheetOf(const StandardTarget& target, const PageSize& page) {
  PrintDrawing sheet;
  sheet.size = {page.width_mm, page.height_mm};
  const double text_width = page.width_mm - 2.0 * kRim_mm;
  const auto write = [&](double top, double height, const std::string& words, Style style) {
    sheet.texts.push_back({{kRim_mm, top}, {text_width, height}, words, style, Align::kLeft});
  };
  write(8.0, 8.0, target.title, Style::kTitle);
  write(16.0, 5.0,
        "Print at 100 % (\u201cactual size\u201d), do not fit to page; matte, stiff paper.",
        Style::kPlain);
  write(20.8, 4.0, target.purpose, Style::kSmall);
  addNet(target, {0.5 * (page.width_mm - target.net.size.x()), kNetTop_mm}, sheet);

  const double ruler_y = kNetTop_mm + std::max(target.net.size.y(), 170.0) + 6.0;
  const double ruler_x = kRim_mm + 2.0;
  addRuler({ruler_x, ruler_y}, Vector2d::UnitX(), sheet);
  addRuler({kDownRulerX_mm + kEndMark_mm, kDownRulerY_mm}, Vector2d::UnitY(), sheet);
  const double beside = ruler_x + kRuler_mm + 4.0;
  sheet.texts.push_back({{beside, ruler_y - 5.0},
                         {page.width_mm - kRim_mm - beside, 12.0},
                         "Two rulers, right and down, of 100 mm each. Measure both with a caliper, "
                         "from the middle of "
                         "one long mark to the middle of the other, and tell Gyre what you read.",
                         Style::kSmall});
  const double steps_y = ruler_y + 8.0;
  write(steps_y, page.height_mm - 12.0 - steps_y, numbered(target.steps), Style::kSmall);
  write(page.height_mm - 12.0, 4.0,
        "Gyre calibration target \u201c" + target.target.name + "\u201d, " +
            std::string(page.name) + ". CC0 1.0: no rights reserved. Goes with the file " +
            target.target.name + ".target.json.",
        Style::kSmall);
  return sheet;
}

}  // namespace gyre
