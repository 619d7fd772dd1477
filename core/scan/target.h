// A calibration target: an object on which the places of many points are known.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// Where two dark and two bright squares meet: what a corner detector finds best.
struct TargetCorner {
  int id = 0;                                                    // unique within the target
  Eigen::Vector3d position_in_target = Eigen::Vector3d::Zero();  // mm
};

// A coded square of the target's dictionary. Its corners go round clockwise as seen from outside,
// from the one that is top left when the code is upright (the order of OpenCV's ArUco). [mm]
struct TargetMarker {
  int id = 0;
  std::array<Eigen::Vector3d, 4> corners_in_target{};
};

// Which ways on a printed face were right and down on the sheet of paper, as unit vectors in the
// target frame: paper shrinks and printers stretch differently along the two.
struct PageAxes {
  Eigen::Vector3d right_in_target = Eigen::Vector3d::Zero();
  Eigen::Vector3d down_in_target = Eigen::Vector3d::Zero();
};

// A round mark in the middle of a square that tells which face and which way round it is; of the
// other colour than its square.
struct TargetDot {
  Eigen::Vector3d centre_in_target = Eigen::Vector3d::Zero();  // mm
  double diameter_mm = 0.0;
};

// Stands on z = 0 of its own frame, z up.
//
// The corners of a face lie on a lattice of squares, dark and bright in turn. Squares that hold a
// marker are bright. Where a face has none, the square at the first corner of its list that lies
// towards the last one is dark. Seen from outside, the squares reach one beyond the outer corners.
struct Target {
  std::string name;
  std::string dictionary;  // "DICT_5X5_250"; empty when it has no markers
  std::vector<TargetCorner> corners;
  std::vector<TargetMarker> markers;
  std::vector<std::vector<int>> faces;  // ids of the corners that share a plane
  std::vector<PageAxes> page_axes;      // one a face, or none when it was not printed by us
  std::vector<TargetDot> dots;
};

// A point of the target that pictures can show.
struct TargetPoint {
  Eigen::Vector3d position_in_target = Eigen::Vector3d::Zero();  // mm
  int face = -1;                                                 // index into faces, -1 for none
  int corner_id = -1;                                            // -1 when a marker's corner
  int marker_id = -1;                                            // -1 when no marker's corner
};

// All points in the order by which sightings name them: the corners in their order, then four a
// marker. A marker belongs to the face in whose plane it lies.
std::vector<TargetPoint> pointsOf(const Target& target);

// The same target with its points elsewhere: one position a point, in that order. [mm]
Target withPoints(Target target, const std::vector<Eigen::Vector3d>& positions_in_target);

}  // namespace gyre
