// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/printed_panel.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/base/units.h"
#include "core/scan/marker_dictionary.h"

namespace gyre {
namespace {

using Ink = PrintPolygon::Ink;

// A rectangle by two opposite corners, moved onto the page by `placed`.
template <class Placed>
PrintPolygon rectangle(Ink ink, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                       const Placed& placed) {
  return {ink,
          {placed(from), placed(Eigen::Vector2d(to.x(), from.y())), placed(to),
           placed(Eigen::Vector2d(from.x(), to.y()))}};
}

int nextCornerId(const Target& target) {
  return target.corners.empty() ? 0 : target.corners.back().id + 1;
}

}  // namespace

void printMarker(const CodedSquare& square, const Panel& panel, Target& target,
                 PrintDrawing& drawing) {
  const auto dictionary = markerDictionary(target.dictionary);
  GYRE_CHECK(dictionary.has_value());
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(square.turned_rad).toRotationMatrix();
  const auto on_panel = [&](const Eigen::Vector2d& from_middle) -> Eigen::Vector2d {
    return square.place + turn * from_middle;
  };
  const auto on_page = [&](const Eigen::Vector2d& from_middle) -> Eigen::Vector2d {
    return panel.onPage(on_panel(from_middle));
  };
  const double half = 0.5 * square.side_mm;
  drawing.polygons.push_back(rectangle(Ink::kBlack, {-half, -half}, {half, half}, on_page));
  const int side = dictionary->modulesASide();
  const double module_mm = square.side_mm / side;
  const auto modules = markerModules(*dictionary, square.id);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (modules[static_cast<std::size_t>(y * side + x)] == 0) continue;
      const Eigen::Vector2d from(x * module_mm - half, y * module_mm - half);
      drawing.polygons.push_back(
          rectangle(Ink::kWhite, from, from + Eigen::Vector2d::Constant(module_mm), on_page));
    }
  }
  target.markers.push_back(
      {square.id,
       {panel.inTarget(on_panel({-half, -half})), panel.inTarget(on_panel({half, -half})),
        panel.inTarget(on_panel({half, half})), panel.inTarget(on_panel({-half, half}))}});
}

void printBoard(const Board& board, const Panel& panel, Target& target, PrintDrawing& drawing) {
  GYRE_CHECK(board.columns >= 2 && board.rows >= 2);
  const double square_mm = board.square_mm;
  const Eigen::Vector2d origin = -0.5 * square_mm * Eigen::Vector2d(board.columns, board.rows);
  const auto on_page = [&](const Eigen::Vector2d& place) { return panel.onPage(place); };
  int marker = board.first_marker;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const Eigen::Vector2d from = origin + square_mm * Eigen::Vector2d(column, row);
      const Eigen::Vector2d to = from + Eigen::Vector2d::Constant(square_mm);
      if ((row + column) % 2 == 0) {
        drawing.polygons.push_back(rectangle(Ink::kBlack, from, to, on_page));
      } else if (board.marker_mm > 0.0) {
        printMarker({marker++, board.marker_mm, 0.5 * (from + to)}, panel, target, drawing);
      }
    }
  }
  std::vector<int> face;
  for (int row = 1; row < board.rows; ++row) {
    for (int column = 1; column < board.columns; ++column) {
      const int id = nextCornerId(target);
      target.corners.push_back(
          {id, panel.inTarget(origin + square_mm * Eigen::Vector2d(column, row))});
      face.push_back(id);
    }
  }
  target.faces.push_back(std::move(face));
  target.page_axes.push_back({panel.right_in_target, panel.down_in_target});
}

void printDot(const RoundMark& mark, const Panel& panel, Target& target, PrintDrawing& drawing) {
  constexpr int kSides = 64;
  PrintPolygon circle{mark.ink, {}};
  for (int i = 0; i < kSides; ++i) {
    const double angle_rad = kTurn_rad * i / kSides;
    circle.outline.push_back(
        panel.onPage(mark.place + 0.5 * mark.diameter_mm *
                                      Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad))));
  }
  drawing.polygons.push_back(std::move(circle));
  target.dots.push_back({panel.inTarget(mark.place), mark.diameter_mm});
}

}  // namespace gyre
