// What a user may change about cleaning up a mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/option_list.h"

namespace gyre {

struct MergeOptions {
  // Vertices at most this far apart become one. [mm], 0..10; more than rounding needs eats detail
  double within_mm = 1e-6;

  template <class V>
  void describe(V& visit) {
    visit({"merge-within", "mm", 0.0, 10.0, "Vertices at most this far apart become one."},
          within_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const MergeOptions&) const = default;
};

// Coordinates at which nothing is cut off: no scan reaches so far. [mm]
inline constexpr double kNoCrop_mm = 10000.0;

struct CropOptions {
  // What lies farther from the table's axis is cut off; 0 cuts nothing. [mm], 0..10000
  double radius_mm = 0.0;
  // What lies beyond these planes is cut off. [mm], table frame, -10000..10000
  double x_min_mm = -kNoCrop_mm;
  double x_max_mm = kNoCrop_mm;
  double y_min_mm = -kNoCrop_mm;
  double y_max_mm = kNoCrop_mm;
  double z_min_mm = -kNoCrop_mm;
  double z_max_mm = kNoCrop_mm;

  template <class V>
  void describe(V& visit) {
    const auto limit = [&](const char* name, const char* text, double& field) {
      visit({name, "mm", -kNoCrop_mm, kNoCrop_mm, text}, field);
    };
    visit({"crop-radius", "mm", 0.0, kNoCrop_mm,
           "What lies farther from the table's axis is cut off; 0 cuts nothing."},
          radius_mm);
    limit("x-min", "What lies below this x is cut off.", x_min_mm);
    limit("x-max", "What lies above this x is cut off.", x_max_mm);
    limit("y-min", "What lies below this y is cut off.", y_min_mm);
    limit("y-max", "What lies above this y is cut off.", y_max_mm);
    limit("z-min", "What lies below this height over the platter is cut off.", z_min_mm);
    limit("z-max", "What lies above this height over the platter is cut off.", z_max_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const CropOptions&) const = default;
};

struct FillHolesOptions {
  // Holes whose rim fits into a box of this diagonal are filled; 0 fills none. [mm], 0..10000
  double max_width_mm = 0.0;
  // Rims wholly at or below this height stay open, for a flat base. [mm], -10000: none
  double spare_below_mm = -kNoCrop_mm;

  template <class V>
  void describe(V& visit) {
    visit({"fill-holes", "mm", 0.0, 10000.0,
           "Holes at most this wide are filled, curved as the surface around; 0 fills none."},
          max_width_mm);
    visit(
        {"spare-below", "mm", -kNoCrop_mm, kNoCrop_mm, "Holes wholly below this height stay open."},
        spare_below_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const FillHolesOptions&) const = default;
};

struct BaseCapOptions {
  // Height of the flat base. [mm], table frame, -10000..10000
  double z_mm = 0.0;
  // Rims that lie wholly within this height above the base are closed. [mm], 0..1000
  double tolerance_mm = 5.0;

  template <class V>
  void describe(V& visit) {
    visit({"base-z", "mm", -kNoCrop_mm, kNoCrop_mm, "Height of the flat base."}, z_mm);
    visit({"base-tolerance", "mm", 0.0, 1000.0,
           "Rims that lie wholly within this height above the base are closed by it."},
          tolerance_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const BaseCapOptions&) const = default;
};

struct SmoothOptions {
  // How often noise is averaged out; 0 does not smooth. 0..1000
  int iterations = 0;
  // No vertex moves farther than this many of its own standard deviations. 0..100
  double max_sigmas = 1.0;
  // Vertices without a sigma move at most this share of the mean edge instead. 0..1
  double max_edge_share = 0.1;
  // Vertices at this height stay at it, so that a flat base stays flat. [mm]; 10000: none
  double hold_z_mm = kNoCrop_mm;

  template <class V>
  void describe(V& visit) {
    visit({"smooth", "", 0, 1000, "How often noise is averaged out; 0 does not smooth."},
          iterations);
    visit({"smooth-sigmas", "", 0.0, 100.0,
           "No vertex moves farther than this many of its own standard deviations."},
          max_sigmas);
    visit({"smooth-share", "", 0.0, 1.0,
           "Vertices of unknown accuracy move at most this share of the mean edge."},
          max_edge_share);
    visit({"smooth-hold-z", "mm", -kNoCrop_mm, kNoCrop_mm, "Vertices at this height stay at it."},
          hold_z_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const SmoothOptions&) const = default;
};

struct DecimateOptions {
  // The mesh gets at most so many triangles; 0 leaves it as it is. 0..100 000 000
  int triangles = 0;
  // Vertices at this height stay at it, so that a flat base stays flat. [mm]; 10000: none
  double hold_z_mm = kNoCrop_mm;

  template <class V>
  void describe(V& visit) {
    visit({"triangles", "", 0, 100000000,
           "The mesh gets at most so many triangles; 0 leaves it as it is."},
          triangles);
    visit({"decimate-hold-z", "mm", -kNoCrop_mm, kNoCrop_mm, "Vertices at this height stay at it."},
          hold_z_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const DecimateOptions&) const = default;
};

struct RemeshOptions {
  // Length that all edges come near to; 0 leaves them as they are. [mm], 0..1000
  double edge_mm = 0.0;
  // Rounds of splitting, joining and flipping edges. 1..100
  int iterations = 5;
  // Edges at which the surface turns by more than this stay edges. [deg], 1..180
  double sharp_deg = 60.0;

  template <class V>
  void describe(V& visit) {
    visit({"remesh", "mm", 0.0, 1000.0,
           "Length that all edges come near to; 0 leaves them as they are."},
          edge_mm);
    visit({"remesh-iterations", "", 1, 100, "Rounds of splitting, joining and flipping edges."},
          iterations);
    visit({"remesh-sharp", "deg", 1.0, 180.0,
           "Edges at which the surface turns by more than this stay edges."},
          sharp_deg);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const RemeshOptions&) const = default;
};

struct WrapOptions {
  // Openings wider than twice this are entered; 0 chooses it from the spacing. [mm], 0..10000
  double alpha_mm = 0.0;
  // How far outside the input the skin is first laid; 0 chooses it from alpha. [mm], 0..1000
  double offset_mm = 0.0;

  template <class V>
  void describe(V& visit) {
    visit({"wrap-alpha", "mm", 0.0, 10000.0,
           "Openings wider than twice this are entered; 0 chooses it from the spacing."},
          alpha_mm);
    visit({"wrap-offset", "mm", 0.0, 1000.0,
           "How far outside the input the skin is first laid; 0 chooses it from alpha."},
          offset_mm);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const WrapOptions&) const = default;
};

// What cleanMesh does. Steps whose size is 0, and crops at their limits, are left out.
struct CleanOptions {
  MergeOptions merge;
  // Pieces with less than this share of the largest one's area are removed. 0..1; 0 keeps all
  double min_component_share = 0.02;
  // Give every surface that touches itself in a vertex or edge its own.
  bool split_non_manifold = true;
  // Turn the triangles so that all agree on which side is outside.
  bool orient = true;
  CropOptions crop;
  FillHolesOptions holes;
  // Close the rim around the bottom by a flat lid.
  bool base_cap = false;
  BaseCapOptions base;
  SmoothOptions smooth;
  DecimateOptions decimate;
  RemeshOptions remesh;

  template <class V>
  void describe(V& visit) {
    merge.describe(visit);
    visit({"min-component", "", 0.0, 1.0,
           "Pieces with less than this share of the largest piece's area are removed."},
          min_component_share);
    visit({"split-non-manifold", "", 0, 1,
           "Separates surfaces that touch in a single vertex or edge."},
          split_non_manifold);
    visit({"orient", "", 0, 1, "Turns all triangles to agree on which side is outside."}, orient);
    crop.describe(visit);
    holes.describe(visit);
    visit({"base-cap", "", 0, 1, "Closes the rim around the bottom by a flat base."}, base_cap);
    base.describe(visit);
    smooth.describe(visit);
    decimate.describe(visit);
    remesh.describe(visit);
  }
  Result<void> validate() const { return validateRanges(*this); }
  bool operator==(const CleanOptions&) const = default;
};

}  // namespace gyre
