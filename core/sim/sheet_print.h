// What is printed on one plane sheet of paper, and how near the edges of the print are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// Squares, dark and bright in turn. Square (i, j) covers [i, i + 1] x [j, j + 1] of the lattice.
struct SquareLattice {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();    // of the lattice, mm on the sheet
  Eigen::Matrix2d step = Eigen::Matrix2d::Identity();  // columns: one square on in i, in j; mm
  Eigen::Array2i first = Eigen::Array2i::Zero();       // the squares that are printed,
  Eigen::Array2i last = Eigen::Array2i::Constant(-1);  // both ends included
  int dark_parity = 0;                                 // of i + j where a square is dark
};

struct SheetCode {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();      // its corner that is top left when upright
  Eigen::Matrix2d module = Eigen::Matrix2d::Identity();  // columns: one module right, one down; mm
  int modules_a_side = 0;
  std::vector<std::uint8_t> modules;  // row by row, 1 is white
};

struct SheetDot {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius_mm = 0.0;
};

// Places are mm on the sheet, x and y along any two axes at right angles. Immutable after the last
// add: any thread may ask.
class SheetPrint {
 public:
  // Beyond this, clearance() no longer tells distances apart. [mm]
  static constexpr float kReach_mm = 1.0F;

  // half_size: the sheet reaches from -half_size to half_size; nothing is printed beyond.
  explicit SheetPrint(const Eigen::Vector2d& half_size);

  void set(const SquareLattice& lattice);
  void add(const SheetCode& code);
  void add(const SheetDot& dot);  // of the other colour than the square it lies in

  bool isDark(const Eigen::Vector2f& place) const;

  // No edge is nearer than this; at most kReach_mm.
  float clearance(const Eigen::Vector2f& place) const;

 private:
  // Rows of cells_from_mm divide lengths: a step of one cell across is at least 1 / its norm long.
  struct Grid {
    Eigen::Vector2f origin = Eigen::Vector2f::Zero();
    Eigen::Matrix2f cells_from_mm = Eigen::Matrix2f::Identity();
    Eigen::Array2f mm_per_cell = Eigen::Array2f::Ones();
    Eigen::Array2f cells(const Eigen::Vector2f& place) const {
      return (cells_from_mm * (place - origin)).array();
    }
  };
  struct Code {
    Grid grid;
    int side = 0;
    std::vector<std::uint8_t> modules;
  };
  struct Dot {
    Eigen::Vector2f centre;
    float radius = 0.0F;
    bool dark = true;
  };
  struct Bin {
    std::vector<std::uint32_t> codes;
    std::vector<std::uint32_t> dots;
  };

  static Grid gridOf(const Eigen::Vector2d& origin, const Eigen::Matrix2d& step);
  bool squareIsDark(const Eigen::Vector2f& place) const;
  const Bin& binAt(const Eigen::Vector2f& place) const;
  template <class Enter>
  void enterBins(const Eigen::Vector2d& centre, double radius_mm, const Enter& enter);

  Eigen::Vector2f half_size_;
  Eigen::Array2i bins_a_side_;
  std::vector<Bin> bins_;
  Bin nothing_;
  bool has_lattice_ = false;
  Grid lattice_grid_;
  SquareLattice lattice_;
  std::vector<Code> codes_;
  std::vector<Dot> dots_;
};

}  // namespace gyre
