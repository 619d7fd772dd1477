// Closed bodies of known volume, for tests: no vertex is doubled.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/base/units.h"
#include "core/scan/mesh.h"

namespace gyre::test {

inline std::uint32_t addVertex(Mesh& mesh, const Eigen::Vector3d& position) {
  MeshVertex vertex;
  vertex.position = position;
  mesh.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

// Eight vertices and twelve triangles, counter-clockwise from outside.
inline Mesh boxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    addVertex(mesh, {(i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                     (i & 4) != 0 ? high.z() : low.z()});
  }
  mesh.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 7, 3}, {2, 6, 7}, {0, 6, 2}, {0, 4, 6}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// A ball about the origin, of so many longitudes and half as many latitudes.
inline Mesh ballMesh(double radius_mm, std::size_t longitudes) {
  const std::size_t latitudes = longitudes / 2;
  Mesh mesh;
  const std::uint32_t south = addVertex(mesh, {0, 0, -radius_mm});
  for (std::size_t row = 1; row < latitudes; ++row) {
    const double up_rad = kPi * (static_cast<double>(row) / static_cast<double>(latitudes) - 0.5);
    for (std::size_t column = 0; column < longitudes; ++column) {
      const double turn_rad =
          kTurn_rad * static_cast<double>(column) / static_cast<double>(longitudes);
      addVertex(mesh, radius_mm * Eigen::Vector3d(std::cos(up_rad) * std::cos(turn_rad),
                                                  std::cos(up_rad) * std::sin(turn_rad),
                                                  std::sin(up_rad)));
    }
  }
  const std::uint32_t north = addVertex(mesh, {0, 0, radius_mm});
  const auto at = [&](std::size_t row, std::size_t column) {
    return static_cast<std::uint32_t>(1 + (row - 1) * longitudes + column % longitudes);
  };
  for (std::size_t column = 0; column < longitudes; ++column) {
    mesh.triangles.push_back({south, at(1, column + 1), at(1, column)});
    mesh.triangles.push_back({north, at(latitudes - 1, column), at(latitudes - 1, column + 1)});
    for (std::size_t row = 1; row + 1 < latitudes; ++row) {
      mesh.triangles.push_back({at(row, column), at(row, column + 1), at(row + 1, column + 1)});
      mesh.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row + 1, column)});
    }
  }
  return mesh;
}

// A torus about z with so many stops along the ring and a quarter as many around the tube.
inline Mesh ringMesh(double ring_mm, double tube_mm, std::size_t stops) {
  const std::size_t around = stops / 4;
  Mesh mesh;
  for (std::size_t i = 0; i < stops; ++i) {
    const double u = kTurn_rad * static_cast<double>(i) / static_cast<double>(stops);
    for (std::size_t j = 0; j < around; ++j) {
      const double v = kTurn_rad * static_cast<double>(j) / static_cast<double>(around);
      const double r = ring_mm + tube_mm * std::cos(v);
      addVertex(mesh, {r * std::cos(u), r * std::sin(u), tube_mm * std::sin(v)});
    }
  }
  const auto at = [&](std::size_t i, std::size_t j) {
    return static_cast<std::uint32_t>((i % stops) * around + j % around);
  };
  for (std::size_t i = 0; i < stops; ++i) {
    for (std::size_t j = 0; j < around; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace gyre::test
