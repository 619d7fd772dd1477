// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/formatted.h"
#include "core/io/experiment_files.h"
#include "core/io/log_axis.h"
#include "core/io/xml_text.h"

namespace gyre {
namespace {

constexpr double kPanelWidth = 250.0;
constexpr double kPanelHeight = 260.0;
constexpr double kGap = 20.0;
constexpr double kLeft = 64.0;
constexpr double kTop = 34.0;
constexpr double kBelow = 52.0;
constexpr double kLegendLine = 18.0;
constexpr double kLegendColumn = 268.0;
constexpr double kRoomUp = 1.25;  // the outermost numbers stay clear of the frame

// Told apart by people who see no colours through their marks, and by all through both.
constexpr std::array<const char*, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                 "#cc79a7", "#56b4e9", "#000000"};
constexpr std::array<const char*, 3> kDashes = {"7 4", "2 3", "9 3 2 3"};

using Row = std::vector<std::optional<double>>;

struct Extent {
  double least = INFINITY;
  double most = 0.0;

  void take(const std::optional<double>& number) {
    if (!number || !(*number > 0.0)) return;
    least = std::min(least, *number);
    most = std::max(most, *number);
  }
  bool empty() const { return !(most > 0.0); }
};

std::string label(double x, double y, const std::string& text, const char* anchor) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) +
         xmlText(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x1, y1, x2, y2,
                   style.c_str());
}

// Filled disc, square, triangle, then the same hollow.
std::string mark(std::size_t curve, double x, double y) {
  const char* colour = kColours[curve % kColours.size()];
  const std::string paint =
      formatted("fill=\"%s\" stroke=\"%s\"", curve % 6 < 3 ? colour : "white", colour);
  switch (curve % 3) {
    case 0:
      return formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.4\" %s/>\n", x, y, paint.c_str());
    case 1:
      return formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"6.4\" height=\"6.4\" %s/>\n", x - 3.2,
                       y - 3.2, paint.c_str());
    default:
      return formatted("<path d=\"M%.1f %.1fl4 7h-8z\" %s/>\n", x, y - 4.4, paint.c_str());
  }
}

std::string styleOf(std::size_t curve, bool dashed) {
  if (dashed) {
    return formatted("fill=\"none\" stroke=\"#444\" stroke-width=\"1.4\" stroke-dasharray=\"%s\"",
                     kDashes[curve % kDashes.size()]);
  }
  return formatted("fill=\"none\" stroke=\"%s\" stroke-width=\"1.6\"",
                   kColours[curve % kColours.size()]);
}

class Drawing {
 public:
  explicit Drawing(const ExperimentTable& table) : table_(table), how_(table.drawing) {
    for (const Row& row : table.rows) {
      if (row[how_.panels_by]) panels_.insert(*row[how_.panels_by]);
      across_.take(row[how_.across]);
      for (const std::size_t column : how_.measured) up_.take(row[column]);
      for (const std::size_t column : how_.compared) up_.take(row[column]);
    }
  }

  std::string svg() const {
    const auto count = static_cast<double>(std::max<std::size_t>(panels_.size(), 1));
    const double width = kLeft + count * (kPanelWidth + kGap);
    const std::size_t curves = how_.measured.size() + how_.compared.size();
    const auto in_a_line =
        std::max<std::size_t>(1, static_cast<std::size_t>((width - kLeft) / kLegendColumn));
    const std::size_t lines = (curves + in_a_line - 1) / in_a_line;
    const double legend = kLegendLine * static_cast<double>(lines);
    const double height = kTop + kPanelHeight + kBelow + legend;
    std::string text = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" "
        "height=\"%.0f\" font-family=\"sans-serif\" font-size=\"12\">\n",
        width, height, width, height);
    text += "<title>" + xmlText(table_.name) + "</title>\n<desc>" + xmlText(table_.caption) +
            "</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    if (!across_.empty() && !up_.empty()) {
      double left = kLeft;
      for (const double value : panels_) {
        text += panel(left, value);
        left += kPanelWidth + kGap;
      }
      text += legendAt(kTop + kPanelHeight + kBelow, in_a_line);
    }
    return text + "</svg>\n";
  }

 private:
  std::string panel(double left, double value) const {
    const LogAxis x(across_.least, across_.most, left + 12.0, left + kPanelWidth - 12.0);
    const LogAxis y(up_.least / kRoomUp, up_.most * kRoomUp, kTop + kPanelHeight, kTop);
    std::string text = formatted(
        "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
        "stroke=\"#888\"/>\n",
        left, kTop, kPanelWidth, kPanelHeight);
    text +=
        label(left + kPanelWidth / 2, kTop - 12.0,
              formatted("%s %g", table_.columns[how_.panels_by].label.c_str(), value), "middle");
    text += axes(left, x, y);
    for (std::size_t i = 0; i < how_.compared.size(); ++i) {
      text += curve(how_.compared[i], value, {x, y}, styleOf(i, true));
    }
    for (std::size_t i = 0; i < how_.measured.size(); ++i) {
      text += curve(how_.measured[i], value, {x, y}, styleOf(i, false));
      for (const auto& [at_x, at_y] : placesOf(how_.measured[i], value, {x, y})) {
        text += mark(i, at_x, at_y);
      }
    }
    return text;
  }

  std::string axes(double left, const LogAxis& x, const LogAxis& y) const {
    const double bottom = kTop + kPanelHeight;
    std::string text;
    for (const double number : y.marks()) {
      const double at = y.placeOf(number);
      text += line(left, at, left + kPanelWidth, at, "stroke=\"#e4e4e4\"");
      if (left == kLeft) text += label(left - 6.0, at + 4.0, formatted("%g", number), "end");
    }
    for (const double number : placesAcross()) {
      const double at = x.placeOf(number);
      text += line(at, bottom, at, bottom + 4.0, "stroke=\"#888\"");
      text += label(at, bottom + 17.0, formatted("%g", number), "middle");
    }
    text += label(left + kPanelWidth / 2, bottom + 35.0, how_.across_label, "middle");
    if (left == kLeft) {
      const double middle = kTop + kPanelHeight / 2;
      text +=
          formatted("<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">",
                    middle) +
          xmlText(how_.up_label) + "</text>\n";
    }
    return text;
  }

  std::set<double> placesAcross() const {
    std::set<double> numbers;
    for (const Row& row : table_.rows) {
      if (row[how_.across] && *row[how_.across] > 0.0) numbers.insert(*row[how_.across]);
    }
    return numbers;
  }

  struct Axes {
    const LogAxis& x;
    const LogAxis& y;
  };

  std::vector<std::pair<double, double>> placesOf(std::size_t column, double panel_value,
                                                  const Axes& axes) const {
    std::vector<std::pair<double, double>> places;
    for (const Row& row : table_.rows) {
      if (row[how_.panels_by] != panel_value || !row[how_.across] || !row[column]) continue;
      if (!(*row[how_.across] > 0.0) || !(*row[column] > 0.0)) continue;
      places.emplace_back(axes.x.placeOf(*row[how_.across]), axes.y.placeOf(*row[column]));
    }
    std::sort(places.begin(), places.end());
    return places;
  }

  std::string curve(std::size_t column, double panel_value, const Axes& axes,
                    const std::string& style) const {
    std::string points;
    for (const auto& [x, y] : placesOf(column, panel_value, axes)) {
      points += formatted("%.1f,%.1f ", x, y);
    }
    if (points.empty()) return {};
    return "<polyline points=\"" + points + "\" " + style + "/>\n";
  }

  std::string legendAt(double top, std::size_t in_a_line) const {
    std::string text;
    const std::size_t marked = how_.measured.size();
    for (std::size_t i = 0; i < marked + how_.compared.size(); ++i) {
      const double x = kLeft + kLegendColumn * static_cast<double>(i % in_a_line);
      const std::size_t line_of_text = i / in_a_line;
      const double y = top + kLegendLine * static_cast<double>(line_of_text);
      const bool dashed = i >= marked;
      text += line(x, y, x + 30.0, y, styleOf(dashed ? i - marked : i, dashed));
      if (!dashed) text += mark(i, x + 15.0, y);
      const std::size_t column = dashed ? how_.compared[i - marked] : how_.measured[i];
      text += label(x + 38.0, y + 4.0, table_.columns[column].label, "start");
    }
    return text;
  }

  const ExperimentTable& table_;
  const ExperimentDrawing& how_;
  std::set<double> panels_;
  Extent across_;
  Extent up_;
};

}  // namespace

std::string svgOf(const ExperimentTable& table) { return Drawing(table).svg(); }

}  // namespace gyre
