// The view orbits, fits and zooms as the mouse says.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

namespace gyre {
namespace {

Bounds box() {
  Bounds bounds;
  bounds.include({-10.0, -20.0, 0.0});
  bounds.include({30.0, 20.0, 40.0});
  return bounds;
}

Eigen::Vector3d eyeOf(const SceneCamera& camera) {
  vtkNew<vtkCamera> vtk;
  camera.applyTo(*vtk);
  return Eigen::Vector3d(vtk->GetPosition());
}

Eigen::Vector3d focusOf(const SceneCamera& camera) {
  vtkNew<vtkCamera> vtk;
  camera.applyTo(*vtk);
  return Eigen::Vector3d(vtk->GetFocalPoint());
}

TEST(SceneCamera, FitsTheWholeBox) {
  SceneCamera camera;
  camera.fit(box());
  EXPECT_TRUE(focusOf(camera).isApprox(Eigen::Vector3d(10.0, 0.0, 20.0)));
  EXPECT_GT(camera.viewHeightMm(), box().diagonal());
}

TEST(SceneCamera, StaysWhenThereIsNothingToFit) {
  SceneCamera camera;
  const Eigen::Vector3d before = eyeOf(camera);
  camera.fit(Bounds{});
  EXPECT_EQ(eyeOf(camera), before);
}

TEST(SceneCamera, LooksFromTheFrontAlongX) {
  SceneCamera camera;
  camera.fit(box());
  camera.lookFrom(ViewSide::kFront);
  const Eigen::Vector3d direction = (eyeOf(camera) - focusOf(camera)).normalized();
  EXPECT_TRUE(direction.isApprox(Eigen::Vector3d::UnitX(), 1e-9));
}

TEST(SceneCamera, ComesNearerByZooming) {
  SceneCamera camera;
  camera.fit(box());
  const double before_mm = camera.viewHeightMm();
  camera.zoom(2.0);
  EXPECT_NEAR(camera.viewHeightMm(), 0.5 * before_mm, 1e-9);
}

TEST(SceneCamera, NeverTipsOver) {
  SceneCamera camera;
  camera.fit(box());
  camera.rotate(0.0, 10.0);
  const Eigen::Vector3d direction = (eyeOf(camera) - focusOf(camera)).normalized();
  EXPECT_LT(direction.z(), 1.0 - 1e-5);
  EXPECT_GT(direction.z(), 0.99);
}

TEST(SceneCamera, KnowsWherePlacesAreSeenAsTheRendererDoes) {
  SceneCamera camera;
  camera.fit(box());
  camera.rotate(0.3, 0.1);
  camera.pan(0.1, -0.2);
  vtkNew<vtkCamera> vtk;
  camera.applyTo(*vtk);
  constexpr double kAspect = 1.6;
  const vtkMatrix4x4* projection = vtk->GetCompositeProjectionTransformMatrix(kAspect, -1.0, 1.0);
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(0, 0, 0), {30, 20, 40}, {-10, -20, 5}, {10, 0, 20}}) {
    const double in[] = {place.x(), place.y(), place.z(), 1.0};
    double out[4];
    const_cast<vtkMatrix4x4*>(projection)->MultiplyPoint(in, out);
    const Eigen::Vector2d seen = camera.seenAt(place);
    EXPECT_NEAR(seen.x(), 0.5 * kAspect * out[0] / out[3], 1e-6);
    EXPECT_NEAR(seen.y(), -0.5 * out[1] / out[3], 1e-6);
  }
}

}  // namespace
}  // namespace gyre
