// Surfaces of known shape, as points and as meshes, for tests.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre::test {

inline Point surfacePoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  Point point;
  point.position = position;
  point.normal = normal;
  return point;
}

// Directions spread evenly over the sphere along a golden spiral.
inline Eigen::Vector3d spiralDirection(std::size_t i, std::size_t count) {
  const double z = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  const double turn_rad = kPi * (3.0 - std::sqrt(5.0)) * static_cast<double>(i);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn_rad), r * std::sin(turn_rad), z};
}

inline PointCloud sphereCloud(std::size_t count, double radius_mm,
                              const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d out = spiralDirection(i, count);
    cloud.points.push_back(surfacePoint(centre + radius_mm * out, out));
  }
  return cloud;
}

// Random points on a torus about z, uniform by area.
inline PointCloud torusCloud(std::size_t count, double ring_mm, double tube_mm) {
  PointCloud cloud;
  Random random(3);
  while (cloud.points.size() < count) {
    const double u = random.uniform(0.0, kTurn_rad);
    const double v = random.uniform(0.0, kTurn_rad);
    const double r = ring_mm + tube_mm * std::cos(v);
    if (random.uniform() * (ring_mm + tube_mm) > r) continue;
    const Eigen::Vector3d normal(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    cloud.points.push_back(surfacePoint(
        Eigen::Vector3d(ring_mm * std::cos(u), ring_mm * std::sin(u), 0.0) + tube_mm * normal,
        normal));
  }
  return cloud;
}

// Adds isotropic noise and writes it into the covariances.
inline void addNoise(PointCloud& cloud, double sigma_mm, std::uint64_t seed) {
  Random random(seed);
  for (Point& point : cloud.points) {
    for (int axis = 0; axis < 3; ++axis) point.position[axis] += sigma_mm * random.gaussian();
    point.covariance = sigma_mm * sigma_mm * Eigen::Matrix3d::Identity();
  }
}

// A grid of (columns x rows) vertices mapped to space, two triangles a cell, counter-clockwise
// where columns run right and rows up. u and v in [0, 1].
inline Mesh gridMesh(std::size_t columns, std::size_t rows,
                     const std::function<Eigen::Vector3d(double u, double v)>& place) {
  Mesh mesh;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      MeshVertex vertex;
      vertex.position = place(static_cast<double>(column) / static_cast<double>(columns - 1),
                              static_cast<double>(row) / static_cast<double>(rows - 1));
      mesh.vertices.push_back(vertex);
    }
  }
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto a = static_cast<std::uint32_t>(row * columns + column);
      const auto up = static_cast<std::uint32_t>(columns);
      mesh.triangles.push_back({a, a + 1, a + up + 1});
      mesh.triangles.push_back({a, a + up + 1, a + up});
    }
  }
  return mesh;
}

// A square of the given side in the plane z = height, looking up.
inline Mesh squareMesh(double side_mm, double height_mm) {
  return gridMesh(11, 11, [=](double u, double v) {
    return Eigen::Vector3d(side_mm * (u - 0.5), side_mm * (v - 0.5), height_mm);
  });
}

// A sphere of longitudes and latitudes; its poles and its seam are doubled vertices.
inline Mesh sphereMesh(double radius_mm, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  return gridMesh(241, 121, [&](double u, double v) {
    const double longitude = kTurn_rad * u;
    const double latitude = kPi * (v - 0.5);
    return Eigen::Vector3d(centre +
                           radius_mm * Eigen::Vector3d(std::cos(latitude) * std::cos(longitude),
                                                       std::cos(latitude) * std::sin(longitude),
                                                       std::sin(latitude)));
  });
}

inline Mesh tetrahedronMesh(const Eigen::Vector3d& corner, double edge_mm) {
  Mesh mesh;
  for (int i = 0; i < 4; ++i) {
    MeshVertex vertex;
    vertex.position = corner;
    if (i > 0) vertex.position[i - 1] += edge_mm;
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

inline Mesh joined(Mesh a, const Mesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles)
    a.triangles.push_back({i + shift, j + shift, k + shift});
  return a;
}

// A cloud as hard as real ones: an upright egg on the table
// with a waist, its lower cap unseen, its density falling tenfold from one side to the other.
inline PointCloud unevenBodyCloud(std::size_t count, double sigma_mm, std::uint64_t seed) {
  PointCloud cloud;
  Random random(seed);
  while (cloud.points.size() < count) {
    const double z = random.uniform();
    const double turn_rad = random.uniform(0.0, kTurn_rad);
    const double density = std::pow(10.0, -0.5 * (1.0 + std::cos(turn_rad)));
    if (z < 0.04 || random.uniform() > density) continue;
    const auto radius = [](double at) {
      return 25.0 * std::sqrt(at * (1.0 - at)) * (1.6 + 0.5 * std::cos(4.0 * kPi * at));
    };
    const auto place = [&](double at, double turn) {
      return Eigen::Vector3d(radius(at) * std::cos(turn), radius(at) * std::sin(turn), 70.0 * at);
    };
    constexpr double kStep = 1e-5;
    const Eigen::Vector3d along = place(z + kStep, turn_rad) - place(z - kStep, turn_rad);
    const Eigen::Vector3d around(-std::sin(turn_rad), std::cos(turn_rad), 0.0);
    cloud.points.push_back(surfacePoint(place(z, turn_rad), around.cross(along).normalized()));
  }
  addNoise(cloud, sigma_mm, seed + 1);
  return cloud;
}

}  // namespace gyre::test
