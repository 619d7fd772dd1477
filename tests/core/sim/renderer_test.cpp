// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/renderer.h"

#include <cmath>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <opencv2/core.hpp>

#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

using Surface = TruePixel::Surface;

RigSettings smallRig() { return atImageWidth({}, 320); }

// The renderer of the default rig at small size, built once for all tests that need no other.
const Renderer& smallRenderer() {
  static const Renderer kRenderer(smallRig());
  return kRenderer;
}

// The same without noise and flicker: what changes, changes for a reason.
const Renderer& quietRenderer() {
  static const Renderer kRenderer([] {
    RigSettings rig = smallRig();
    rig.noise_sigma = rig.background_flicker = 0.0;
    return rig;
  }());
  return kRenderer;
}

std::size_t pixelAt(const RigSettings& rig, const Eigen::Vector2d& uv) {
  return static_cast<std::size_t>(std::lround(uv.y())) *
             static_cast<std::size_t>(rig.image_width_px) +
         static_cast<std::size_t>(std::lround(uv.x()));
}

bool samePictures(const Frame& a, const Frame& b) {
  const std::size_t bytes = a.image_bgr.total() * a.image_bgr.elemSize();
  return a.image_bgr.size() == b.image_bgr.size() &&
         std::equal(a.image_bgr.data, a.image_bgr.data + bytes, b.image_bgr.data);
}

int levelAt(const Frame& frame, std::size_t pixel) { return frame.image_bgr.data[3 * pixel + 1]; }

TEST(Renderer, EveryTruePixelProjectsOntoItself) {
  RigSettings rig = smallRig();
  rig.k1 = -0.3;  // strong, so that a lens that is left out would show
  const Renderer renderer(rig);
  const Calibration truth = trueCalibration(rig);
  const std::int64_t steps = 400;
  const Rigid3 cam_from_table = camFromTable(*truth.cam_from_table, trueAngleRad(rig, steps));
  const auto pixels = renderer.truePixels(steps, TableLoad::kObject);
  int on_object = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i].surface != Surface::kObject) continue;
    ++on_object;
    const Eigen::Vector3d in_cam = cam_from_table * pixels[i].point_in_table.cast<double>();
    const auto uv = truth.camera.project(in_cam);
    ASSERT_TRUE(uv.has_value());
    const Eigen::Vector2d centre(static_cast<double>(i % 320),
                                 static_cast<double>(i / 320));  // NOLINT
    ASSERT_NEAR((*uv - centre).norm(), 0.0, 2e-3);               // single precision along 350 mm
    ASSERT_NEAR(in_cam.z(), static_cast<double>(pixels[i].depth_mm), 1e-3);
  }
  EXPECT_GT(on_object, 2500);
}

TEST(Renderer, VerticesInFrontAreFoundAtTheirPixels) {
  const RigSettings rig = smallRig();
  const Renderer& renderer = smallRenderer();
  const Calibration truth = trueCalibration(rig);
  const Rigid3 cam_from_table = camFromTable(*truth.cam_from_table, trueAngleRad(rig, 900));
  const Eigen::Vector3d camera_in_table = cam_from_table.inverse().translation;
  const auto pixels = renderer.truePixels(900, TableLoad::kObject);
  int checked = 0;
  int agreeing = 0;
  for (const MeshVertex& vertex : renderer.object().mesh().vertices) {
    const Eigen::Vector3d to_camera = (camera_in_table - vertex.position).normalized();
    if (vertex.normal.dot(to_camera) < 0.5) continue;
    const Eigen::Vector3d in_cam = cam_from_table * vertex.position;
    const TruePixel& pixel = pixels[pixelAt(rig, *truth.camera.project(in_cam))];
    ++checked;
    // Half a pixel aside (0.3 mm) on a surface at 60 degrees changes the depth by 0.5 mm.
    const double depth = static_cast<double>(pixel.depth_mm);
    if (pixel.surface == Surface::kObject && depth > in_cam.z() - 0.9)
      agreeing += depth < in_cam.z() + 0.9 ? 1 : 0;
    // Otherwise something of the object must stand in front of it.
    else if (pixel.surface == Surface::kObject)
      ++agreeing;
  }
  EXPECT_GT(checked, 5000);
  EXPECT_GT(agreeing, 0.999 * checked);
}

TEST(Renderer, SameArgumentsGiveTheSamePictureOnAnyNumberOfThreads) {
  const Frame many = smallRenderer().render(123, TableLoad::kObject);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Frame single = Renderer(smallRig()).render(123, TableLoad::kObject);
  EXPECT_TRUE(samePictures(many, single));
}

TEST(Renderer, SeedChangesThePicture) {
  RigSettings other = smallRig();
  other.seed = 9;
  EXPECT_FALSE(samePictures(smallRenderer().render(0, TableLoad::kEmpty),
                            Renderer(other).render(0, TableLoad::kEmpty)));
}

TEST(Renderer, PlatterTurnsAndBackgroundStandsStill) {
  const Renderer& renderer = quietRenderer();
  const Frame before = renderer.render(0, TableLoad::kEmpty);
  const Frame after = renderer.render(700, TableLoad::kEmpty);
  const auto pixels = renderer.truePixels(0, TableLoad::kEmpty);
  int platter = 0;
  int platter_changed = 0;
  int background_changed = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int change = std::abs(levelAt(before, i) - levelAt(after, i));
    if (pixels[i].surface == Surface::kPlatter) {
      ++platter;
      platter_changed += change > 4 ? 1 : 0;
      continue;
    }
    // The blur carries platter light three pixels over its edge.
    bool near_platter = false;
    for (std::size_t dy : {std::size_t{0}, std::size_t{320 * 4}}) {
      for (std::size_t dx = 0; dx <= 4; ++dx) {
        for (const std::size_t j : {i + dy + dx, i + dy - dx, i - dy + dx, i - dy - dx}) {
          near_platter =
              near_platter || (j < pixels.size() && pixels[j].surface == Surface::kPlatter);
        }
      }
    }
    if (!near_platter) background_changed += change > 0 ? 1 : 0;
  }
  EXPECT_GT(platter_changed, platter / 2);
  EXPECT_EQ(background_changed, 0);
}

TEST(Renderer, PlatterTextureMovesAsTheTableTurns) {
  const Renderer& renderer = quietRenderer();
  const RigSettings& rig = renderer.rig();
  const Calibration truth = trueCalibration(rig);
  const Frame first = renderer.render(0, TableLoad::kEmpty);
  const Frame second = renderer.render(160, TableLoad::kEmpty);
  const Rigid3 later = camFromTable(*truth.cam_from_table, trueAngleRad(rig, 160));
  double moved = 0.0;
  double unmoved = 0.0;
  for (double x = -50.0; x <= 50.0; x += 2.0) {
    for (double y = -35.0; y <= 35.0; y += 2.0) {
      const Eigen::Vector3d point(x, y, 0.0);
      const std::size_t at_first =
          pixelAt(rig, *truth.camera.project(*truth.cam_from_table * point));
      const std::size_t at_second = pixelAt(rig, *truth.camera.project(later * point));
      moved += std::abs(levelAt(first, at_first) - levelAt(second, at_second));
      unmoved += std::abs(levelAt(first, at_first) - levelAt(second, at_first));
    }
  }
  EXPECT_LT(moved, 0.55 * unmoved);  // nearest pixels only, so not zero
}

TEST(Renderer, BackgroundFlickers) {
  RigSettings rig = smallRig();
  rig.noise_sigma = 0.0;
  rig.background_flicker = 0.05;
  const Renderer renderer(rig);
  const Frame first = renderer.render(0, TableLoad::kEmpty);
  const Frame second = renderer.render(1, TableLoad::kEmpty);
  double change = 0.0;
  for (std::size_t i = 0; i < 320 * 20; ++i) change += levelAt(first, i) - levelAt(second, i);
  EXPECT_GT(std::abs(change), 320 * 20 * 0.2);
}

TEST(Renderer, GlossHighlightsAddLight) {
  RigSettings glossy = smallRig();
  glossy.material = "glossy";
  glossy.noise_sigma = glossy.background_flicker = 0.0;
  const Renderer shining(glossy);
  const Frame with = shining.render(0, TableLoad::kObject);
  const Frame without = quietRenderer().render(0, TableLoad::kObject);
  const auto pixels = shining.truePixels(0, TableLoad::kObject);
  int brighter = 0;
  int darker = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    brighter += levelAt(with, i) > levelAt(without, i) + 20 ? 1 : 0;
    darker += levelAt(with, i) < levelAt(without, i) ? 1 : 0;
  }
  EXPECT_GT(brighter, 50);
  EXPECT_EQ(darker, 0);
}

TEST(Renderer, EmptyTableShowsNoObject) {
  for (const TruePixel& pixel : smallRenderer().truePixels(0, TableLoad::kEmpty)) {
    ASSERT_NE(pixel.surface, Surface::kObject);
  }
}

// How far the background of two pictures differs, in grey levels, when one is moved by whole
// pixels.
double differenceWhenMoved(const Frame& before, const Frame& after, int right_px) {
  const cv::Rect corner(20, 10, 60, 40);  // above the platter
  return cv::norm(before.image_bgr(corner), after.image_bgr(corner + cv::Point(right_px, 0)),
                  cv::NORM_L1) /
         (3.0 * static_cast<double>(corner.area()));
}

TEST(Renderer, AKnockMovesThePictureFromItsAngleOn) {
  RigSettings knocked = quietRenderer().rig();
  knocked.bump_px = 3.0;
  knocked.bump_at_deg = 90.0;
  const Renderer renderer(knocked);
  const int quarter = knocked.steps_per_turn / 4;
  EXPECT_TRUE(samePictures(renderer.render(quarter - 1, TableLoad::kObject),
                           quietRenderer().render(quarter - 1, TableLoad::kObject)));
  const Frame still = quietRenderer().render(quarter, TableLoad::kObject);
  const Frame moved = renderer.render(quarter, TableLoad::kObject);
  EXPECT_LT(differenceWhenMoved(still, moved, 3), 0.3 * differenceWhenMoved(still, moved, 0));
}

TEST(Renderer, APushMovesTheTableAndNothingElse) {
  RigSettings pushed = quietRenderer().rig();
  pushed.push_mm = 4.0;
  pushed.bump_at_deg = 90.0;
  const Renderer renderer(pushed);
  const int quarter = pushed.steps_per_turn / 4;
  EXPECT_TRUE(samePictures(renderer.render(quarter - 1, TableLoad::kObject),
                           quietRenderer().render(quarter - 1, TableLoad::kObject)));
  const Frame still = quietRenderer().render(quarter, TableLoad::kObject);
  const Frame moved = renderer.render(quarter, TableLoad::kObject);
  const cv::Rect corner(20, 10, 60, 40);  // above the platter
  EXPECT_EQ(cv::norm(still.image_bgr(corner), moved.image_bgr(corner), cv::NORM_INF), 0.0);
  // The object is where the camera sees it when that steps as far to its other side.
  const auto before = quietRenderer().truePixels(quarter, TableLoad::kObject);
  const auto after = renderer.truePixels(quarter, TableLoad::kObject);
  const auto middleOf = [&](const std::vector<TruePixel>& pixels) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (pixels[i].surface != Surface::kObject) continue;
      sum += static_cast<double>(i % static_cast<std::size_t>(pushed.image_width_px));
      ++count;
    }
    return sum / count;
  };
  const double px_per_mm = pushed.focal_px / pushed.camera_distance_mm;
  EXPECT_NEAR(middleOf(after) - middleOf(before), 4.0 * px_per_mm, 1.0 * px_per_mm);
}

}  // namespace
}  // namespace gyre
