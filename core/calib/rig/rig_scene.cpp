// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <span>

#include "core/calib/rig/rig_problem.h"

namespace gyre {

RigScene sceneOf(std::span<const TargetView> views, const Target& target, TargetShape shape) {
  RigScene scene;
  if (shape == TargetShape::kFreeFaces) scene.faces = facePiecesOf(target);
  if (shape == TargetShape::kLooseMarkers) scene.faces = loosePiecesOf(target);
  const std::vector<TargetPoint> points = pointsOf(target);
  scene.face_of.assign(points.size(), scene.faces.size());
  for (std::size_t face = 0; face < scene.faces.size(); ++face) {
    for (const int point : scene.faces[face].points) {
      scene.face_of[static_cast<std::size_t>(point)] = face;
    }
  }
  scene.faces.emplace_back();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TargetPiece& face = scene.faces[scene.face_of[i]];
    FacePoint point = facePoint(target, face, points[i].face, points[i].position_in_target);
    if (scene.face_of[i] + 1 == scene.faces.size()) point.bow.setZero();
    scene.points.push_back(point);
  }
  scene.has_page_axes = shape == TargetShape::kFreeFaces && !target.page_axes.empty();
  for (std::size_t k = 0; k < views.size(); ++k) {
    scene.commanded_rad.push_back(std::nullopt);
    if (views[k].table_angle_rad && views[0].table_angle_rad) {
      scene.commanded_rad.back() = *views[k].table_angle_rad - *views[0].table_angle_rad;
    }
    for (const PointSighting& seen : views[k].sightings) {
      scene.sightings.push_back(
          {k, static_cast<std::size_t>(seen.point), seen.pixel, seen.sigma_px, true});
    }
  }
  return scene;
}

Eigen::Matrix<double, kFaceSize, 1> FoldPriors::sigmas() const {
  Eigen::Matrix<double, kFaceSize, 1> sigmas;
  sigmas.head<3>().setConstant(turn_rad);
  sigmas.segment<3>(3).setConstant(shift_mm);
  sigmas.tail<3>().setConstant(bow_mm);
  return sigmas;
}

RigParameters RigState::at(std::size_t view, std::size_t face) const {
  RigParameters parameters;
  parameters.camera = cameraVector(frames.camera);
  parameters.angle_rad = angles_rad[view];
  parameters.face = faces[face];
  parameters.page_stretch = page_stretch;
  return parameters;
}

std::vector<Eigen::Vector2d> residualsOf(const RigScene& scene, const RigState& state) {
  std::vector<Eigen::Vector2d> residuals;
  residuals.reserve(scene.sightings.size());
  for (const RigSighting& seen : scene.sightings) {
    Eigen::Vector2d pixel = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    projectRig(state.frames, state.at(seen.view, scene.face_of[seen.point]),
               scene.points[seen.point], &pixel, nullptr);
    residuals.push_back(seen.pixel - pixel);
  }
  return residuals;
}

}  // namespace gyre
