// Every alpha shape of a set of points, from one triangulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/tetrahedra.h"
#include "core/scan/mesh.h"

namespace gyre {

// A triangle of an alpha shape.
struct AlphaFacet {
  Triangle corners{};       // indices of points, counter-clockwise seen from the outside
  double radius_mm = 0.0;   // of the triangle's circumscribed circle
  bool both_sides = false;  // the outside touches it from behind as well: a sheet
  std::uint32_t cell = 0;   // of the triangulation
  std::uint8_t side = 0;    // of that cell
};

// Of every facet of a Delaunay triangulation, the radii alpha at which it belongs to the boundary
// of the alpha shape (general mode, as CGAL's Alpha_shape_3 has it): it joins the shape when its
// own smallest ball, where that holds no other point, or the ball of a cell beside it is no larger
// than alpha, and it is inside when the balls of both cells are. With a spacing for each point,
// alpha and all radii count in spacings, the mean of those at the corners. Edelsbrunner and Muecke,
// "Three-dimensional alpha shapes" (1994). Reading is safe from any thread.
class AlphaFiltration {
 public:
  // spacing_mm: of each point, or empty.
  explicit AlphaFiltration(Tetrahedra tetrahedra, std::span<const double> spacing_mm = {});

  const Tetrahedra& tetrahedra() const { return tetrahedra_; }

  // All radii at which some facet joins or leaves the boundary, ascending. [mm]
  std::vector<double> alphasMm() const;

  // The boundary at alpha >= 0: what is outside or inside is told by the cells alone, so the walls
  // of hollows are there too. A facet without a solid cell beside it is a sheet.
  std::vector<AlphaFacet> boundary(double alpha_mm) const;

  // The part of it that a ball of this radius touches which comes from infinity and passes through
  // no facet of the shape: walls of hollows that it cannot enter are left out.
  std::vector<AlphaFacet> outerBoundary(double alpha_mm) const;

 private:
  void setJoins(std::uint32_t cell, std::span<const double> spacing_mm);
  bool isSolid(std::uint32_t cell, double alpha_mm2) const;
  std::vector<char> reachedFromInfinity(double alpha_mm2) const;
  // Calls visit(cell, side, next) for the facets of the boundary, each once.
  template <class Visit>
  void forBoundary(double alpha_mm2, const Visit& visit) const;
  AlphaFacet seenFrom(std::uint32_t cell, std::uint8_t side, bool front, bool back) const;

  Tetrahedra tetrahedra_;
  std::vector<double> cell_radius_mm2_;  // squared; infinite for cells that reach infinity
  // Of each cell and side, alpha^2 from which it belongs to the shape; never where it reaches
  // infinity. It leaves the boundary at the larger of its cells' radii.
  std::vector<std::array<double, 4>> joins_mm2_;
};

}  // namespace gyre
