// What a user may change about surfaces.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/option_list.h"

namespace gyre {

struct AlphaShapeOptions {
  // Radius of the largest empty ball that may not pass through the surface; 0 lets the spacing of
  // the points decide. [mm], 0..1000; larger closes holes, smaller opens clefts and handles.
  double alpha_mm = 0.0;
  // Alpha as a multiple of the points' even spacing, used when alpha_mm is 0. 1..20
  double alpha_spacings = 5.0;
  // Points nearer together than this are thinned; 0 lets spacing and noise decide. [mm], 0..1000
  double spacing_mm = 0.0;
  // Components with less than this share of the largest one's area are left out. 0..1
  double min_component_share = 0.02;

  template <class V>
  void describe(V& visit) {
    visit(
        {"alpha", "mm", 0.0, 1000.0,
         "Radius of the ball that may not pass through the surface; 0 chooses it from the points' "
         "spacing. Larger closes holes, smaller keeps clefts open."},
        alpha_mm);
    visit({"alpha-spacings", "", 1.0, 20.0,
           "Alpha as a multiple of the points' spacing, where alpha is 0."},
          alpha_spacings);
    visit({"spacing", "mm", 0.0, 1000.0,
           "Points nearer together than this are thinned; 0 lets spacing and noise decide."},
          spacing_mm);
    visit({"min-component", "", 0.0, 1.0,
           "Pieces with less than this share of the largest piece's area are left out."},
          min_component_share);
  }

  Result<void> validate() const { return validateRanges(*this); }
};

struct PoissonOptions {
  // Points nearer together than this are thinned, and triangles get about this size; 0 lets spacing
  // and noise decide. [mm], 0..1000
  double spacing_mm = 0.0;

  template <class V>
  void describe(V& visit) {
    visit({"spacing", "mm", 0.0, 1000.0,
           "Points nearer together than this are thinned; 0 lets spacing and noise decide."},
          spacing_mm);
  }

  Result<void> validate() const { return validateRanges(*this); }
};

struct VisualHullOptions {
  // From one point of the lattice to the next, about the length of a triangle's side; 0 takes a
  // share of the object's size. [mm], 0..1000; time grows with its inverse squared.
  double cell_mm = 0.0;
  // Share of the outlines that may be wrong at any place without cutting into the body. 0..0.4;
  // larger forgives more and rounds less of what few views show.
  double disbelieved_share = 0.02;
  // Bites and gaps in an outline narrower than this share of the width of the whole are filled.
  // 0..0.5; smaller keeps narrow gaps, and grooves where background and object look alike.
  double gap_share = 0.08;
  // Pieces with less than this share of the largest one's area are left out. 0..1
  double min_component_share = 0.02;

  template <class V>
  void describe(V& visit) {
    visit({"hull-cell", "mm", 0.0, 1000.0,
           "How fine a body from outlines is; 0 takes a share of the object's size."},
          cell_mm);
    visit({"hull-disbelieved", "", 0.0, 0.4,
           "Share of the outlines that may be wrong at a place without cutting into the body."},
          disbelieved_share);
    visit({"hull-gap", "", 0.0, 0.5,
           "Bites and gaps in an outline narrower than this share of its width are filled."},
          gap_share);
    visit({"min-component", "", 0.0, 1.0,
           "Pieces with less than this share of the largest piece's area are left out."},
          min_component_share);
  }

  Result<void> validate() const { return validateRanges(*this); }
};

struct VisibilityCutOptions {
  // Points nearer together than this are thinned; 0 lets spacing and noise decide. [mm], 0..1000
  double spacing_mm = 0.0;
  // So many lines of sight of each point are followed, spread over its views. 1..200; time grows
  // with it.
  int rays_per_point = 8;
  // How much smooth walls of even triangles are preferred: what a wall of bad triangles costs,
  // against one line of sight cut through. 0..100; larger closes gaps with fewer folds, and cuts
  // off thin parts that few cameras saw.
  double quality = 2.0;
  // Pieces with less than this share of the largest one's volume are left out. 0..1
  double min_component_share = 0.02;

  template <class V>
  void describe(V& visit) {
    visit({"spacing", "mm", 0.0, 1000.0,
           "Points nearer together than this are thinned; 0 lets spacing and noise decide."},
          spacing_mm);
    visit({"rays-per-point", "", 1, 200, "Lines of sight of each point that are followed."},
          rays_per_point);
    visit({"quality", "", 0.0, 100.0,
           "Preference for smooth walls, against one line of sight cut through."},
          quality);
    visit({"min-component", "", 0.0, 1.0,
           "Pieces with less than this share of the largest piece's volume are left out."},
          min_component_share);
  }

  Result<void> validate() const { return validateRanges(*this); }
};

}  // namespace gyre
