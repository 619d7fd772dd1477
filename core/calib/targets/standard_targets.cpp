// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/standard_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/units.h"
#include "core/calib/targets/paper_net.h"
#include "core/calib/targets/printed_panel.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr const char* kDictionary = "DICT_5X5_250";
// Ids of the coded targets, one range each.
constexpr int kCubeMarkers = 0;
constexpr int kWedgeMarkers = 60;
constexpr int kFlatMarkers = 101;
constexpr int kRingMarkers = 132;

constexpr double kCubeSide_mm = 50.0;
constexpr double kWedgeWidth_mm = 68.0;
constexpr double kWedgeFront_mm = 68.0;  // up the slope
constexpr double kFrontSlope_rad = radFromDeg(40.0);
constexpr double kBackSlope_rad = radFromDeg(60.0);
constexpr double kFlap_mm = 8.0;
constexpr double kMarker_mm = 7.0;  // in squares of 9 mm: modules of exactly 1 mm

// The six sides of a cube as a cross: back, top, front and base in a column, left and right beside
// the top, so that all five sides that are seen hang together.
struct CubePanels {
  Panel top;
  std::array<Panel, 4> sides;  // front, right, back, left
  Panel base;
};

CubePanels cubePanels() {
  const double a = kCubeSide_mm;
  const double h = 0.5 * a;
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  CubePanels panels;
  panels.top = {{1.5 * a, 1.5 * a}, a * z, x, -y};
  panels.sides = {Panel{{1.5 * a, 2.5 * a}, h * z - h * y, x, -z},
                  Panel{{2.5 * a, 1.5 * a}, h * z + h * x, -z, -y},
                  Panel{{1.5 * a, 0.5 * a}, h * z + h * y, x, z},
                  Panel{{0.5 * a, 1.5 * a}, h * z - h * x, z, -y}};
  panels.base = {{1.5 * a, 3.5 * a}, Vector3d::Zero(), x, y};
  return panels;
}

void drawCubeNet(const CubePanels& panels, PrintDrawing& net) {
  const double a = kCubeSide_mm;
  net.size = {3.0 * a, 4.0 * a + kFlap_mm};
  // Round the cross, clockwise as it lies on the page: edges that are glued carry a flap.
  cutLine({a, a}, {a, 0}, net);
  cutLine({a, 0}, {2 * a, 0}, net);
  cutLine({2 * a, 0}, {2 * a, a}, net);
  flap({2 * a, a}, {3 * a, a}, kFlap_mm, net);
  cutLine({3 * a, a}, {3 * a, 2 * a}, net);
  flap({3 * a, 2 * a}, {2 * a, 2 * a}, kFlap_mm, net);
  cutLine({2 * a, 2 * a}, {2 * a, 3 * a}, net);
  flap({2 * a, 3 * a}, {2 * a, 4 * a}, kFlap_mm, net);
  flap({2 * a, 4 * a}, {a, 4 * a}, kFlap_mm, net);
  flap({a, 4 * a}, {a, 3 * a}, kFlap_mm, net);
  cutLine({a, 3 * a}, {a, 2 * a}, net);
  flap({a, 2 * a}, {0, 2 * a}, kFlap_mm, net);
  cutLine({0, 2 * a}, {0, a}, net);
  flap({0, a}, {a, a}, kFlap_mm, net);
  foldLine({a, a}, {2 * a, a}, net);
  foldLine({2 * a, a}, {2 * a, 2 * a}, net);
  foldLine({2 * a, 2 * a}, {a, 2 * a}, net);
  foldLine({a, 2 * a}, {a, a}, net);
  foldLine({a, 3 * a}, {2 * a, 3 * a}, net);
  label(panels.base.centre_on_page, "Base: stands on the table", net);
}

std::vector<std::string> cubeSteps() {
  return {"Cut along the outer solid lines; the seven flaps stay on.",
          "Score the dashed lines with a blunt blade along a ruler, and fold them away from the "
          "print to right angles.",
          "Glue each flap behind the neighbouring side, the base last; press until it is dry. The "
          "sides must stay flat and the corners square."};
}

StandardTarget cube() {
  StandardTarget made;
  made.target.name = "cube";
  made.title = "Checkerboard cube";
  made.purpose = "The classic cube of known corners, without codes; its dot marks the top.";
  made.steps = cubeSteps();
  const CubePanels panels = cubePanels();
  // Even, so that the pattern shows which way round a side is; 25 corners on each.
  const Board board{6, 6, 7.5};
  printBoard(board, panels.top, made.target, made.net);
  for (const Panel& side : panels.sides) printBoard(board, side, made.target, made.net);
  // Off the middle of the one side that a camera above sees at every angle.
  printDot({4.0, Vector2d(0.5 * board.square_mm, -0.5 * board.square_mm)}, panels.top, made.target,
           made.net);
  drawCubeNet(panels, made.net);
  return made;
}

StandardTarget codedCube() {
  StandardTarget made;
  made.target.name = "coded-cube";
  made.target.dictionary = kDictionary;
  made.title = "Coded cube";
  made.purpose = "Corners that name themselves on five sides: sees the table from every angle.";
  made.steps = cubeSteps();
  const CubePanels panels = cubePanels();
  Board board{5, 5, 9.0, kMarker_mm, kCubeMarkers};
  const int markers_a_side = board.columns * board.rows / 2;
  printBoard(board, panels.top, made.target, made.net);
  for (const Panel& side : panels.sides) {
    board.first_marker += markers_a_side;
    printBoard(board, side, made.target, made.net);
  }
  drawCubeNet(panels, made.net);
  return made;
}

// A prism that lies on its side: a slope of 40 degrees in front, a steeper one behind it.
struct WedgeShape {
  double height_mm = kWedgeFront_mm * std::sin(kFrontSlope_rad);
  double back_mm = height_mm / std::sin(kBackSlope_rad);
  double front_foot_mm = kWedgeFront_mm * std::cos(kFrontSlope_rad);
  double base_mm = front_foot_mm + back_mm * std::cos(kBackSlope_rad);
  double flap_reach_mm = kFlap_mm * std::sin(kBackSlope_rad);
  double left_mm = height_mm + flap_reach_mm;  // of the column of panels on the page
};

// The column on the page: back, front, base; the walls hang on both sides of the base.
void drawWedgeNet(const WedgeShape& shape, PrintDrawing& net) {
  const double left = shape.left_mm;
  const double right = left + kWedgeWidth_mm;
  const double ridge = shape.back_mm;
  const double toe = ridge + kWedgeFront_mm;
  const double heel = toe + shape.base_mm;
  net.size = {right + left, heel + kFlap_mm};
  cutLine({left, 0}, {right, 0}, net);
  cutLine({right, 0}, {right, toe}, net);
  cutLine({left, 0}, {left, toe}, net);
  foldLine({left, ridge}, {right, ridge}, net);
  foldLine({left, toe}, {right, toe}, net);
  flap({right, heel}, {left, heel}, kFlap_mm, net);
  const double apex_y = toe + shape.front_foot_mm;
  const Vector2d right_apex(right + shape.height_mm, apex_y);
  const Vector2d left_apex(left - shape.height_mm, apex_y);
  foldLine({right, toe}, {right, heel}, net);
  foldLine({left, toe}, {left, heel}, net);
  flap({right, toe}, right_apex, kFlap_mm, net);
  flap(right_apex, {right, heel}, kFlap_mm, net);
  flap({left, heel}, left_apex, kFlap_mm, net);
  flap(left_apex, {left, toe}, kFlap_mm, net);
  label({0.5 * (left + right), 0.5 * (toe + heel)}, "Base: stands on the table", net);
  label({right + 0.4 * shape.height_mm, apex_y}, "Wall", net);
  label({left - 0.4 * shape.height_mm, apex_y}, "Wall", net);
}

StandardTarget wedge() {
  StandardTarget made;
  made.target.name = "wedge";
  made.target.dictionary = kDictionary;
  made.title = "Coded wedge";
  made.purpose = "The easiest to fold, and good enough for every rig whose camera looks down.";
  made.steps = {
      "Cut along the outer solid lines; the five flaps stay on.",
      "Score the dashed lines with a blunt blade along a ruler, and fold all of them away from the "
      "print.",
      "Glue the long flap behind the edge of the upper panel, then the flaps of both walls behind "
      "the printed faces; press until it is dry. The printed faces must stay flat."};
  const WedgeShape shape;
  const double front_slope_y = std::cos(kFrontSlope_rad);
  const double front_slope_z = std::sin(kFrontSlope_rad);
  const Vector3d front_down(0.0, -front_slope_y, -front_slope_z);
  const Vector3d back_down(0.0, -std::cos(kBackSlope_rad), std::sin(kBackSlope_rad));
  const Vector3d toe(0.0, -0.5 * shape.base_mm, 0.0);
  const Vector3d heel(0.0, 0.5 * shape.base_mm, 0.0);
  const double middle = shape.left_mm + 0.5 * kWedgeWidth_mm;
  const Panel front{{middle, shape.back_mm + 0.5 * kWedgeFront_mm},
                    toe - 0.5 * kWedgeFront_mm * front_down,
                    Vector3d::UnitX(),
                    front_down};
  const Panel back{{middle, 0.5 * shape.back_mm},
                   heel + 0.5 * shape.back_mm * back_down,
                   Vector3d::UnitX(),
                   back_down};
  const Board front_board{7, 7, 9.0, kMarker_mm, kWedgeMarkers};
  Board back_board{7, 5, 9.0, kMarker_mm, kWedgeMarkers};
  back_board.first_marker += front_board.columns * front_board.rows / 2;
  printBoard(front_board, front, made.target, made.net);
  printBoard(back_board, back, made.target, made.net);
  drawWedgeNet(shape, made.net);
  return made;
}

StandardTarget flat() {
  StandardTarget made;
  made.target.name = "flat";
  made.target.dictionary = kDictionary;
  made.title = "Flat coded board";
  made.purpose =
      "To be held by hand in many ways, for the lens alone; lying on the table it says too little.";
  made.steps = {"Cut along the solid line.",
                "Glue it, without bubbles, on something that is truly flat and stiff: glass, a "
                "tile, a thick board."};
  const Board board{9, 7, 10.0, 8.0, kFlatMarkers};
  constexpr double kMargin_mm = 6.0;
  made.net.size =
      Vector2d(board.columns, board.rows) * board.square_mm + Vector2d::Constant(2.0 * kMargin_mm);
  Panel panel;
  panel.centre_on_page = 0.5 * made.net.size;
  printBoard(board, panel, made.target, made.net);
  const double right = made.net.size.x();
  const double bottom = made.net.size.y();
  cutLine({0, 0}, {right, 0}, made.net);
  cutLine({right, 0}, {right, bottom}, made.net);
  cutLine({right, bottom}, {0, bottom}, made.net);
  cutLine({0, bottom}, {0, 0}, made.net);
  return made;
}

StandardTarget ring(const std::string& name, double diameter_mm, int first_marker) {
  constexpr int kMarkers = 24;
  constexpr double kRingMarker_mm = 8.0;
  constexpr double kRimToMarker_mm = 7.5;
  constexpr double kBand_mm = 14.0;
  StandardTarget made;
  made.target.name = name;
  made.target.dictionary = kDictionary;
  made.title = "Ring of codes, " + std::to_string(std::lround(diameter_mm)) + " mm";
  made.purpose = "Stays on the platter and tells the table's angle in every picture.";
  made.steps = {"Cut along both circles.",
                "Glue it flat on the platter, its middle on the axis as well as you can: a "
                "millimetre aside does no harm, a bubble does."};
  const double radius = 0.5 * diameter_mm;
  made.net.size = Vector2d::Constant(diameter_mm);
  Panel panel;
  panel.centre_on_page = 0.5 * made.net.size;
  for (int i = 0; i < kMarkers; ++i) {
    // Counter-clockwise seen from above, beginning at the target's x axis; the codes' upper sides
    // look outward.
    const double angle_rad = kTurn_rad * i / kMarkers;
    const double place = radius - kRimToMarker_mm;
    printMarker(
        {first_marker + i, kRingMarker_mm,
         place * Vector2d(std::cos(angle_rad), -std::sin(angle_rad)), 0.25 * kTurn_rad - angle_rad},
        panel, made.target, made.net);
  }
  cutCircle(panel.centre_on_page, radius, made.net);
  cutCircle(panel.centre_on_page, radius - kBand_mm, made.net);
  return made;
}

constexpr std::array<std::pair<const char*, double>, 4> kRings = {
    {{"ring", 120.0}, {"ring-100", 100.0}, {"ring-140", 140.0}, {"ring-160", 160.0}}};

}  // namespace

const std::vector<std::string>& standardTargetNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = {"cube", "wedge", "coded-cube", "flat"};
    for (const auto& [name, diameter_mm] : kRings) names.emplace_back(name);
    return names;
  }();
  return kNames;
}

Result<StandardTarget> standardTarget(const std::string& name) {
  if (name == "cube") return cube();
  if (name == "wedge") return wedge();
  if (name == "coded-cube") return codedCube();
  if (name == "flat") return flat();
  int first_marker = kRingMarkers;
  for (const auto& [ring_name, diameter_mm] : kRings) {
    if (name == ring_name) return ring(name, diameter_mm, first_marker);
    first_marker += 24;
  }
  std::string known;
  for (const std::string& each : standardTargetNames()) known += (known.empty() ? "" : ", ") + each;
  return Error{Error::Code::kInvalidInput, "There is no calibration target '" + name + "'.",
               "Choose one of: " + known + "."};
}

}  // namespace gyre
