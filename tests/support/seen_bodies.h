// Bodies of known shape, sampled and seen by cameras all around, for tests of surfaces.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/sight_evidence.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre::test {

struct Body {
  std::string name;
  // Signed distance from the surface, negative inside; no larger than the true one. [mm]
  std::function<double(const Eigen::Vector3d&)> distance_mm;
  // How far apart points shall lie at a place. [mm]
  std::function<double(const Eigen::Vector3d&)> spacing_mm;
  double reach_mm = 0.0;  // the body lies within this distance from the origin
  int euler_number = 2;
};

Body sphereBody();   // radius 20, spacing 1.2
Body torusBody();    // ring 20, tube 8, spacing 1.2
Body plateBody();    // 30 x 20, two sides two spacings apart
Body cubeBody();     // side 24, sharp edges, spacing 1.2
Body tenfoldBody();  // a sphere whose spacing grows tenfold from one pole to the other

struct SeenBody {
  PointCloud cloud;  // with views, normals as the program finds them, and covariances of the noise
  SightEvidence sights;  // 24 cameras over the sphere
};

// Points on the body, no two nearer than its spacing, moved by isotropic noise of the share of the
// spacing in each direction; seen by each camera that they face by more than 17 degrees and that
// nothing hides.
SeenBody seenBody(const Body& body, double noise_share, std::uint64_t seed);

// The share q of the mesh's area lies nearer to the true surface, in spacings there.
double errorInSpacings(const Mesh& mesh, const Body& body, double q);

}  // namespace gyre::test
