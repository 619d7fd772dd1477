// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/seen_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/mesh/point_normals.h"
#include "core/mesh/surface_samples.h"
#include "tests/support/surfaces.h"

namespace gyre::test {
namespace {

constexpr std::size_t kCameras = 24;
constexpr double kCameraDistance_mm = 300.0;
constexpr double kLeastFacing = 0.3;
constexpr int kTriesPerPoint = 40;

double boxDistance(const Eigen::Vector3d& place, const Eigen::Vector3d& half) {
  const Eigen::Vector3d off = place.cwiseAbs() - half;
  return off.cwiseMax(0.0).norm() + std::min(off.maxCoeff(), 0.0);
}

Eigen::Vector3d normalAt(const Body& body, const Eigen::Vector3d& place) {
  constexpr double kStep_mm = 1e-4;
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep_mm * Eigen::Vector3d::Unit(axis);
    gradient[axis] = body.distance_mm(place + step) - body.distance_mm(place - step);
  }
  return gradient.normalized();
}

bool isHidden(const Body& body, const Eigen::Vector3d& place, const Eigen::Vector3d& towards) {
  double along_mm = 0.05;
  while (along_mm < 2.0 * body.reach_mm) {
    const double free_mm = body.distance_mm(place + along_mm * towards);
    if (free_mm < 1e-3) return true;
    along_mm += free_mm;
  }
  return false;
}

// Throws darts at the surface and keeps those that no earlier one is near to.
std::vector<Eigen::Vector3d> samplesOf(const Body& body, Random& random) {
  std::vector<Eigen::Vector3d> kept;
  double least_mm = 1e300;
  double most_mm = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    const double spacing_mm = body.spacing_mm(body.reach_mm * spiralDirection(i, 200));
    least_mm = std::min(least_mm, spacing_mm);
    most_mm = std::max(most_mm, spacing_mm);
  }
  const double cell_mm = std::sqrt(least_mm * most_mm);
  const auto darts = static_cast<std::size_t>(kTriesPerPoint * 4.0 * kPi * body.reach_mm *
                                              body.reach_mm / (least_mm * least_mm));
  std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
  const auto cell_of = [&](const Eigen::Vector3d& place) {
    return std::array{static_cast<int>(std::floor(place.x() / cell_mm)),
                      static_cast<int>(std::floor(place.y() / cell_mm)),
                      static_cast<int>(std::floor(place.z() / cell_mm))};
  };
  for (std::size_t dart = 0; dart < darts; ++dart) {
    Eigen::Vector3d place(random.gaussian(), random.gaussian(), random.gaussian());
    place *= body.reach_mm * std::cbrt(random.uniform()) / place.norm();
    for (int step = 0; step < 20 && std::abs(body.distance_mm(place)) > 1e-7; ++step) {
      place -= body.distance_mm(place) * normalAt(body, place);
    }
    if (std::abs(body.distance_mm(place)) > 1e-6) continue;
    const double spacing_mm = body.spacing_mm(place);
    const int reach = static_cast<int>(std::ceil(spacing_mm / cell_mm));
    const auto at = cell_of(place);
    bool alone = true;
    for (int x = -reach; x <= reach && alone; ++x) {
      for (int y = -reach; y <= reach && alone; ++y) {
        for (int z = -reach; z <= reach && alone; ++z) {
          const auto found = cells.find({at[0] + x, at[1] + y, at[2] + z});
          if (found == cells.end()) continue;
          for (const std::size_t other : found->second) {
            alone = alone && (kept[other] - place).norm() >= spacing_mm;
          }
        }
      }
    }
    if (!alone) continue;
    cells[at].push_back(kept.size());
    kept.push_back(place);
  }
  return kept;
}

}  // namespace

Body sphereBody() {
  return {"sphere", [](const Eigen::Vector3d& p) { return p.norm() - 20.0; },
          [](const Eigen::Vector3d&) { return 1.2; }, 20.0, 2};
}

Body torusBody() {
  return {"torus",
          [](const Eigen::Vector3d& p) {
            return Eigen::Vector2d(p.head<2>().norm() - 20.0, p.z()).norm() - 8.0;
          },
          [](const Eigen::Vector3d&) { return 1.2; }, 28.0, 0};
}

Body plateBody() {
  return {"plate",
          [](const Eigen::Vector3d& p) {
            return boxDistance(p, {15.0, 10.0, 0.8});
          },
          [](const Eigen::Vector3d&) { return 0.8; }, 18.1, 2};
}

Body cubeBody() {
  return {"cube",
          [](const Eigen::Vector3d& p) { return boxDistance(p, Eigen::Vector3d::Constant(12.0)); },
          [](const Eigen::Vector3d&) { return 1.2; }, 20.8, 2};
}

Body tenfoldBody() {
  return {"tenfold", [](const Eigen::Vector3d& p) { return p.norm() - 20.0; },
          [](const Eigen::Vector3d& p) { return 0.4 * std::pow(10.0, (p.z() + 20.0) / 40.0); },
          20.0, 2};
}

SeenBody seenBody(const Body& body, double noise_share, std::uint64_t seed) {
  SeenBody seen;
  for (std::size_t i = 0; i < kCameras; ++i) {
    seen.sights.camera_centres.push_back(kCameraDistance_mm * spiralDirection(i, kCameras));
  }
  Random random(seed);
  std::vector<Eigen::Vector3d> towards_cameras;
  for (const Eigen::Vector3d& place : samplesOf(body, random)) {
    const Eigen::Vector3d normal = normalAt(body, place);
    Point point;
    Eigen::Vector3d towards_all = Eigen::Vector3d::Zero();
    for (std::uint32_t camera = 0; camera < kCameras; ++camera) {
      const Eigen::Vector3d towards = (seen.sights.camera_centres[camera] - place).normalized();
      if (towards.dot(normal) < kLeastFacing || isHidden(body, place, towards)) continue;
      point.views.push_back(camera);
      towards_all += towards;
    }
    const double sigma_mm = noise_share * body.spacing_mm(place);
    point.position = place;
    for (int axis = 0; axis < 3; ++axis) point.position[axis] += sigma_mm * random.gaussian();
    point.covariance = sigma_mm * sigma_mm * Eigen::Matrix3d::Identity();
    seen.cloud.points.push_back(std::move(point));
    towards_cameras.push_back(towards_all);
  }
  (void)setPointNormals(seen.cloud, towards_cameras, {}, {});
  return seen;
}

double errorInSpacings(const Mesh& mesh, const Body& body, double q) {
  std::vector<double> errors;
  for (const SurfaceSample& sample : sampleSurface(mesh, 20000)) {
    errors.push_back(std::abs(body.distance_mm(sample.position)) /
                     body.spacing_mm(sample.position));
  }
  if (errors.empty()) return 1e300;
  std::sort(errors.begin(), errors.end());
  return errors[static_cast<std::size_t>(q * static_cast<double>(errors.size() - 1))];
}

}  // namespace gyre::test
