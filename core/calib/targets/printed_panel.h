// One flat part of a paper target: what is printed on it, on the page and in space.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/calib/targets/print_drawing.h"
#include "core/scan/target.h"

namespace gyre {

// Where a part of the sheet is on the page, and where it is once the target is folded. Its sides
// run along the page's.
struct Panel {
  Eigen::Vector2d centre_on_page = Eigen::Vector2d::Zero();
  Eigen::Vector3d centre_in_target = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_in_target = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down_in_target = -Eigen::Vector3d::UnitY();

  // From a place on the panel, mm right and down of its centre.
  Eigen::Vector2d onPage(const Eigen::Vector2d& place) const { return centre_on_page + place; }
  Eigen::Vector3d inTarget(const Eigen::Vector2d& place) const {
    return centre_in_target + place.x() * right_in_target + place.y() * down_in_target;
  }
};

// A checkerboard with its upper left square dark; with coded squares in its bright ones when
// marker_mm is above zero, numbered row by row as OpenCV's ChArUco boards of odd rows are.
struct Board {
  int columns = 5;
  int rows = 5;
  double square_mm = 9.0;
  double marker_mm = 0.0;
  int first_marker = 0;
};

// Prints the board in the middle of the panel: adds its inner corners, row by row with the next
// free ids, as a face of the target, and its squares to the drawing. The target's dictionary must
// be known when there are markers.
void printBoard(const Board& board, const Panel& panel, Target& target, PrintDrawing& drawing);

// Prints one coded square. place: its centre on the panel; turned clockwise by the angle.
struct CodedSquare {
  int id = 0;
  double side_mm = 8.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double turned_rad = 0.0;
};
void printMarker(const CodedSquare& square, const Panel& panel, Target& target,
                 PrintDrawing& drawing);

// Prints a round mark.
struct RoundMark {
  double diameter_mm = 4.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  PrintPolygon::Ink ink = PrintPolygon::Ink::kBlack;
};
void printDot(const RoundMark& mark, const Panel& panel, Target& target, PrintDrawing& drawing);

}  // namespace gyre
