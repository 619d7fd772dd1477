// What stands under the pointer in the 3D scene, and what is drawn between such places.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <QString>

#include <Eigen/Core>

namespace gyre {

struct ScenePick {
  enum class On { kTriangle, kPoint };
  On on = On::kTriangle;
  std::size_t index = 0;                               // of the triangle or the point
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // on it, mm, table frame
};

// While the scene is for picking, a click tells what it hit instead of doing nothing.
enum class Picking { kOff, kOn };

// A measured length between two places; a single place while its ends are the same.
struct SceneLine {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // mm, table frame
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  QString text;
};

}  // namespace gyre
