// What a sheet of paper shows, as plain geometry that any painter can put on a page.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// All places in mm from the upper left corner, x right and y down.
struct PrintPolygon {
  enum class Ink { kBlack, kWhite };  // white lies on top of black
  Ink ink = Ink::kBlack;
  std::vector<Eigen::Vector2d> outline;
};

struct PrintLine {
  enum class Kind { kCut, kFold, kFlap, kRuler };  // flap: the outline of what is glued
  Kind kind = Kind::kCut;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

// Words in a box, broken into lines where its width asks for it.
struct PrintText {
  enum class Style { kTitle, kPlain, kSmall };
  enum class Align { kLeft, kCentre };
  Eigen::Vector2d top_left = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  std::string words;
  Style style = Style::kPlain;
  Align align = Align::kLeft;
};

// Two end marks whose distance a caliper measures.
struct PrintRuler {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

struct PrintDrawing {
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  // mm
  std::vector<PrintPolygon> polygons;
  std::vector<PrintLine> lines;
  std::vector<PrintText> texts;
  std::vector<PrintRuler> rulers;  // their marks are among the lines
};

}  // namespace gyre
