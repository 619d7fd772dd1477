// The perspective map of a plane into a picture, of the whole plane or of the part around a place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace gyre {

// A place on a plane, in any unit, and where a picture shows it.
struct PlaneSighting {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double weight = 1.0;
};

// pixel ~ H (place, 1), by the normalised direct linear transformation. Returns nothing for fewer
// than four sightings, or when they do not determine it (all but one on a line).
// Hartley and Zisserman, "Multiple View Geometry", algorithm 4.2.
std::optional<Eigen::Matrix3d> fitHomography(std::span<const PlaneSighting> sightings);

// The same from the sightings whose places are nearest to a place, weighted down with distance:
// around it the map of a distorting lens is nearly a homography, however bent the whole is.
std::optional<Eigen::Matrix3d> fitHomographyNear(std::span<const PlaneSighting> sightings,
                                                 const Eigen::Vector2d& place,
                                                 std::size_t most_sightings);

Eigen::Vector2d throughHomography(const Eigen::Matrix3d& pixel_from_place,
                                  const Eigen::Vector2d& place);

// d(pixel) / d(place) there.
Eigen::Matrix2d homographyJacobian(const Eigen::Matrix3d& pixel_from_place,
                                   const Eigen::Vector2d& place);

// The least length in the picture of a step of unit length on the plane, its smaller singular
// value. [px a unit]
double leastStretch(const Eigen::Matrix2d& jacobian);

}  // namespace gyre
