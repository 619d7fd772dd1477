// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/rendered_target.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <Eigen/Dense>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/calib/match/target_face.h"
#include "core/geometry/turntable_pose.h"
#include "core/scan/marker_dictionary.h"

namespace gyre::test {
namespace {

enum class Ink { kNone, kDark, kBright };

struct DrawnMarker {
  Eigen::Vector2d origin, right, down;  // of a whole side
  std::vector<std::uint8_t> modules;
  int count = 0;
};

// One printed face, asked for its colour place by place.
class DrawnFace {
 public:
  DrawnFace(const Target& target, const TargetFace& face) : face_(face) {
    const auto dictionary = markerDictionary(target.dictionary);
    for (const auto& marker : face.markers) {
      const Eigen::Vector2d origin = marker.corners_mm[0];
      markers_.push_back({origin, marker.corners_mm[1] - origin, marker.corners_mm[3] - origin,
                          markerModules(*dictionary, marker.id), dictionary->modulesASide()});
    }
    for (const auto& dot : target.dots) {
      const Eigen::Vector3d off = dot.centre_in_target - face.origin_in_target;
      if (std::abs(face.outwardInTarget().dot(off)) > 0.05) continue;
      dots_.emplace_back(face.placeOf(dot.centre_in_target), 0.5 * dot.diameter_mm);
    }
    if (face.grid) {
      least_ = most_ = face.corners.front().place_mm;
      for (const auto& corner : face.corners) {
        least_ = least_.cwiseMin(corner.place_mm);
        most_ = most_.cwiseMax(corner.place_mm);
      }
      const Eigen::Vector2d towards = face.corners.back().place_mm - face.corners[0].place_mm;
      Eigen::Vector2d known = face.corners[0].place_mm;
      known += 0.5 * face.grid->pitch_mm.cwiseProduct(towards.cwiseSign());
      dark_parity_ = parityAt(known);
      if (!markers_.empty()) {
        dark_parity_ =
            1 - parityAt(markers_[0].origin + 0.5 * (markers_[0].right + markers_[0].down));
      }
    } else {
      least_ = most_ = markers_.empty() ? Eigen::Vector2d(0, 0) : markers_[0].origin;
    }
  }

  const TargetFace& face() const { return face_; }

  Ink at(const Eigen::Vector2d& place) const {
    if (!face_.grid) return Ink::kNone;
    const Eigen::Array2d margin = 1.25 * face_.grid->pitch_mm.array();
    if ((place.array() < least_.array() - margin).any() ||
        (place.array() > most_.array() + margin).any()) {
      return Ink::kNone;
    }
    for (const auto& [centre, radius] : dots_) {
      if ((place - centre).norm() < radius) return flipped(squareAt(centre));
    }
    return squareAt(place);
  }

 private:
  static Ink flipped(Ink ink) { return ink == Ink::kDark ? Ink::kBright : Ink::kDark; }

  int parityAt(const Eigen::Vector2d& place) const {
    const Eigen::Array2d cell = ((place - least_).array() / face_.grid->pitch_mm.array()).floor();
    return (static_cast<int>(cell.x()) + static_cast<int>(cell.y())) & 1;
  }

  Ink squareAt(const Eigen::Vector2d& place) const {
    const Eigen::Array2d reach = face_.grid->pitch_mm.array();
    if ((place.array() < least_.array() - reach).any() ||
        (place.array() > most_.array() + reach).any()) {
      return Ink::kBright;
    }
    for (const DrawnMarker& marker : markers_) {
      const Eigen::Vector2d off = place - marker.origin;
      const double x = off.dot(marker.right) / marker.right.squaredNorm();
      const double y = off.dot(marker.down) / marker.down.squaredNorm();
      if (x < 0 || y < 0 || x >= 1 || y >= 1) continue;
      const int column = static_cast<int>(x * marker.count);
      const int row = static_cast<int>(y * marker.count);
      return marker.modules[static_cast<std::size_t>(row * marker.count + column)] != 0
                 ? Ink::kBright
                 : Ink::kDark;
    }
    return parityAt(place) == dark_parity_ ? Ink::kDark : Ink::kBright;
  }

  TargetFace face_;
  std::vector<DrawnMarker> markers_;
  std::vector<std::pair<Eigen::Vector2d, double>> dots_;
  Eigen::Vector2d least_, most_;
  int dark_parity_ = 0;
};

struct World {
  const Target& target;
  const TargetScene& scene;
  std::vector<DrawnFace> faces;
  std::vector<DrawnMarker> loose;  // markers of no face, on z = 0
  Eigen::Vector3d camera;          // in the target frame
  Eigen::Vector3d middle;          // of the target
  double reach = 0.0;              // nothing of it is farther from there

  bool mayHit(const Eigen::Vector3d& ray) const {
    return (middle - camera).cross(ray).norm() <= reach * ray.norm();
  }

  double brightnessAlong(const Eigen::Vector3d& ray) const {
    double nearest = std::numeric_limits<double>::max();
    double brightness = scene.ground;
    const auto level = [&](Ink ink) { return ink == Ink::kDark ? scene.dark : scene.bright; };
    if (std::abs(ray.z()) > 1e-9 && -camera.z() / ray.z() > 0.0) {
      nearest = -camera.z() / ray.z() + 1e-6;
      const Eigen::Vector3d hit = camera + nearest * ray;
      if (scene.cloth_square_mm > 0.0) {
        const int column = static_cast<int>(std::floor(hit.x() / scene.cloth_square_mm + 0.37));
        const int row = static_cast<int>(std::floor(hit.y() / scene.cloth_square_mm + 0.21));
        brightness = ((column + row) & 1) != 0 ? scene.dark : scene.bright;
      }
      for (const DrawnMarker& marker : loose) {
        const Eigen::Vector2d off = hit.head<2>() - marker.origin;
        const double x = off.dot(marker.right) / marker.right.squaredNorm() * marker.count;
        const double y = off.dot(marker.down) / marker.down.squaredNorm() * marker.count;
        if (x < -1 || y < -1 || x >= marker.count + 1 || y >= marker.count + 1) continue;
        const bool code = x >= 0 && y >= 0 && x < marker.count && y < marker.count;
        const auto module =
            static_cast<std::size_t>(static_cast<int>(y) * marker.count + static_cast<int>(x));
        brightness = code && marker.modules[module] == 0 ? scene.dark : scene.bright;
      }
    }
    for (const DrawnFace& drawn : faces) {
      const TargetFace& face = drawn.face();
      const double slope = face.outwardInTarget().dot(ray);
      if (std::abs(slope) < 1e-9) continue;
      const double distance = face.outwardInTarget().dot(face.origin_in_target - camera) / slope;
      if (distance <= 0.0 || distance >= nearest) continue;
      const Ink ink = drawn.at(face.placeOf(camera + distance * ray));
      if (ink == Ink::kNone) continue;
      nearest = distance;
      brightness = slope < 0.0 ? level(ink) : scene.ground;
    }
    return brightness;
  }
};

World worldOf(const Target& target, const TargetScene& scene, const Eigen::Vector3d& camera) {
  World world{target, scene, {}, {}, camera, Eigen::Vector3d::Zero()};
  for (const TargetFace& face : facesOf(target)) {
    if (!face.corners.empty()) world.faces.emplace_back(target, face);
  }
  const auto points = pointsOf(target);
  const auto dictionary = markerDictionary(target.dictionary);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].marker_id < 0) continue;
    if (points[i].face < 0) {
      const Eigen::Vector2d origin = points[i].position_in_target.head<2>();
      world.loose.push_back({origin, points[i + 1].position_in_target.head<2>() - origin,
                             points[i + 3].position_in_target.head<2>() - origin,
                             markerModules(*dictionary, points[i].marker_id),
                             dictionary->modulesASide()});
    }
    i += 3;
  }
  for (const auto& point : points) world.middle += point.position_in_target;
  world.middle /= static_cast<double>(std::max<std::size_t>(1, points.size()));
  for (const auto& point : points) {
    world.reach = std::max(world.reach, (point.position_in_target - world.middle).norm());
  }
  world.reach *= 2.0;  // margins of white, and more
  return world;
}

}  // namespace

cv::Mat renderTarget(const Target& target, const CameraModel& camera, const Rigid3& cam_from_target,
                     const TargetScene& scene) {
  const Rigid3 target_from_cam = cam_from_target.inverse();
  const World world = worldOf(target, scene, target_from_cam.translation);
  cv::Mat sharp(camera.height_px, camera.width_px, CV_32F);
  constexpr int kSamples = 16;
  parallelFor(static_cast<std::size_t>(sharp.rows), 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < sharp.cols; ++x) {
        const Eigen::Vector2d centre = camera.normalizedFromPixel(Eigen::Vector2d(x, y));
        const double light = 1.0 - scene.shade * x / sharp.cols;
        if (scene.cloth_square_mm <= 0.0 &&
            !world.mayHit(target_from_cam.rotation * centre.homogeneous())) {
          sharp.at<float>(y, x) = static_cast<float>(light * scene.ground);
          continue;
        }
        const Eigen::Matrix2d back = camera.pixelJacobian(centre).inverse();
        double sum = 0.0;
        for (int k = 0; k < kSamples; ++k) {
          // No two samples share a row or a column: edges along either are as smooth as others.
          const Eigen::Vector2d off((k + 0.5) / kSamples - 0.5,
                                    (5 * k % kSamples + 0.5) / kSamples - 0.5);
          const Eigen::Vector2d place = centre + back * off;
          sum += world.brightnessAlong(target_from_cam.rotation * place.homogeneous());
        }
        sharp.at<float>(y, x) = static_cast<float>(light * sum / kSamples);
      }
    }
  });
  // The samples' box has blurred by 1/12 px^2 already.
  cv::Mat blurred;
  const double more = std::sqrt(std::max(0.01, scene.psf_px * scene.psf_px - 1.0 / 12.0));
  cv::GaussianBlur(sharp, blurred, {0, 0}, more);
  Random random(scene.seed);
  cv::Mat image(blurred.size(), CV_8UC3);
  for (int y = 0; y < blurred.rows; ++y) {
    for (int x = 0; x < blurred.cols; ++x) {
      const double value = blurred.at<float>(y, x) + scene.noise * random.gaussian();
      image.at<cv::Vec3b>(y, x) = cv::Vec3b::all(cv::saturate_cast<uchar>(value));
    }
  }
  return image;
}

CameraModel plainCamera(int width_px, int height_px) {
  CameraModel camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx = camera.fy = 1.4 * width_px;
  camera.cx = 0.5 * (width_px - 1);
  camera.cy = 0.5 * (height_px - 1);
  return camera;
}

Rigid3 lookAtTarget(double distance_mm, double elevation_rad, double table_angle_rad,
                    double aim_height_mm) {
  const Eigen::Vector3d from(0.0, -distance_mm * std::cos(elevation_rad),
                             aim_height_mm + distance_mm * std::sin(elevation_rad));
  const Eigen::Vector3d forward = (Eigen::Vector3d(0.0, 0.0, aim_height_mm) - from).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Rigid3 cam_from_base;
  cam_from_base.rotation << right.transpose(), forward.cross(right).transpose(),
      forward.transpose();
  cam_from_base.translation = -cam_from_base.rotation * from;
  return camFromTable(cam_from_base, table_angle_rad);
}

std::optional<Eigen::Vector2d> truePixel(const Target& target, const CameraModel& camera,
                                         const Rigid3& cam_from_target, int point) {
  return camera.project(cam_from_target *
                        pointsOf(target)[static_cast<std::size_t>(point)].position_in_target);
}

void saveOverlay(const cv::Mat& image, const Overlay& overlay, const std::string& name) {
  const char* folder = std::getenv("GYRE_TEST_OVERLAYS");
  if (folder == nullptr) return;
  cv::Mat drawn;
  if (image.channels() == 1) {
    cv::cvtColor(image, drawn, cv::COLOR_GRAY2BGR);
  } else {
    drawn = image.clone();
  }
  const std::vector<cv::Scalar> colours = {{0, 0, 255},   {0, 200, 0},   {255, 80, 0},
                                           {0, 200, 255}, {255, 0, 255}, {200, 200, 0}};
  for (std::size_t i = 0; i < overlay.points.size(); ++i) {
    const auto group = overlay.groups.empty() ? 0 : static_cast<std::size_t>(overlay.groups[i]);
    const cv::Point2d at(overlay.points[i].x(), overlay.points[i].y());
    cv::circle(drawn, at, 5, colours[group % colours.size()], 1, cv::LINE_AA);
    cv::drawMarker(drawn, at, colours[group % colours.size()], cv::MARKER_CROSS, 3);
  }
  cv::imwrite(std::string(folder) + "/" + name + ".png", drawn);
}

}  // namespace gyre::test
