// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/vertex_colours.h"

#include <cmath>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/looking_cameras.h"
#include "tests/support/solids.h"

namespace gyre {
namespace {

constexpr int kViews = 24;

// Red above the equator, blue below.
cv::Vec3b paintAt(const Eigen::Vector3d& place, double middle_z_mm) {
  return place.z() > middle_z_mm ? cv::Vec3b(20, 40, 200) : cv::Vec3b(180, 60, 30);
}

// The picture of balls, each painted; a highlight, white, where the ball's normal points halfway
// between the camera and a light beside it. Drawn by intersecting the ray of every pixel.
cv::Mat picture(const CameraModel& camera, const Rigid3& cam_from_table,
                const std::vector<Eigen::Vector4d>& balls) {
  cv::Mat image(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(90, 90, 90));
  const Rigid3 table_from_cam = cam_from_table.inverse();
  const Eigen::Vector3d half = Eigen::Vector3d(0.4, -0.3, -1.0).normalized();
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const Eigen::Vector3d ray = camera.rayInCam({static_cast<double>(x), static_cast<double>(y)});
      double nearest = 1e9;
      for (const Eigen::Vector4d& ball : balls) {
        const Eigen::Vector3d centre = cam_from_table * ball.head<3>().eval();
        const double along = ray.dot(centre);
        const double inside = along * along - centre.squaredNorm() + ball.w() * ball.w();
        if (inside < 0.0 || along - std::sqrt(inside) >= nearest) continue;
        nearest = along - std::sqrt(inside);
        const Eigen::Vector3d hit = nearest * ray;
        const bool shines = (hit - centre).normalized().dot(half) > 0.97;
        image.at<cv::Vec3b>(y, x) =
            shines ? cv::Vec3b(255, 255, 255) : paintAt(table_from_cam * hit, ball.z());
      }
    }
  }
  return image;
}

struct World {
  CameraModel camera = test::plainCamera();
  std::vector<Rigid3> poses = test::turnOfViews(test::lookAt({0, 0, 0}, 400.0, 0.4), kViews);
  std::vector<Eigen::Vector4d> balls = {{0, 0, 0, 20}};
  Mesh mesh;

  World() {
    mesh = test::ballMesh(20.0, 60);
    computeNormals(mesh);
  }
  std::vector<PosedCamera> cameras() const {
    std::vector<PosedCamera> all;
    for (const Rigid3& pose : poses) all.push_back({camera, pose});
    return all;
  }
  PictureOfView pictures() const {
    return
        [this](std::size_t view) -> Result<cv::Mat> { return picture(camera, poses[view], balls); };
  }
};

bool isPaint(const MeshVertex& vertex, double tolerance) {
  const cv::Vec3b paint = paintAt(vertex.position, 0.0);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const int expected = paint[static_cast<int>(2 - channel)];
    if (std::abs(vertex.rgb[channel] - expected) > tolerance) return false;
  }
  return true;
}

TEST(ColourVertices, FindsThePaintUnderAHighlight) {
  World world;
  const auto coloured = colourVertices(world.mesh, world.cameras(), world.pictures(), {});
  ASSERT_TRUE(coloured) << coloured.error().sentence();
  EXPECT_GT(*coloured, world.mesh.vertices.size() / 2);
  for (const MeshVertex& vertex : world.mesh.vertices) {
    if (std::abs(vertex.position.z()) < 1.5) continue;  // the line between the paints
    if (vertex.views >= 6) {
      EXPECT_TRUE(isPaint(vertex, 3)) << vertex.position.transpose();
    }
  }
}

TEST(ColourVertices, GivesWhatNoPictureShowsTheColourBesideIt) {
  World world;
  ASSERT_TRUE(colourVertices(world.mesh, world.cameras(), world.pictures(), {}));
  const MeshVertex& south = world.mesh.vertices.front();
  EXPECT_EQ(south.views, 0);
  EXPECT_TRUE(isPaint(south, 3));
}

// A small ball hovers over the large one: its paint must not land on what it hides.
TEST(ColourVertices, LooksPastWhatHidesASurface) {
  World world;
  Mesh small = test::ballMesh(6.0, 40);
  for (MeshVertex& vertex : small.vertices) vertex.position += Eigen::Vector3d(0, 0, 28);
  const auto first = static_cast<std::uint32_t>(world.mesh.vertices.size());
  world.balls.emplace_back(0, 0, 28, 6);
  world.mesh.vertices.insert(world.mesh.vertices.end(), small.vertices.begin(),
                             small.vertices.end());
  for (const auto& [a, b, c] : small.triangles) {
    world.mesh.triangles.push_back({a + first, b + first, c + first});
  }
  computeNormals(world.mesh);
  ASSERT_TRUE(colourVertices(world.mesh, world.cameras(), world.pictures(), {}));
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < first; ++v) {
    const MeshVertex& vertex = world.mesh.vertices[v];
    // The lower half of the small ball is blue, the top of the large one red.
    if (vertex.position.z() > 10.0 && vertex.views > 0 && !isPaint(vertex, 3)) ++wrong;
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(ColourVertices, RefusesPicturesOfAnotherSizeAndStops) {
  World world;
  const Mesh before = world.mesh;
  const auto small = [](std::size_t) -> Result<cv::Mat> {
    return cv::Mat(10, 10, CV_8UC3, cv::Scalar());
  };
  EXPECT_FALSE(colourVertices(world.mesh, world.cameras(), small, {}));
  std::stop_source stop;
  stop.request_stop();
  const auto stopped =
      colourVertices(world.mesh, world.cameras(), world.pictures(), Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
  for (std::size_t v = 0; v < before.vertices.size(); ++v) {
    EXPECT_EQ(world.mesh.vertices[v].rgb, before.vertices[v].rgb);
  }
}

TEST(ColourFromPoints, TakesTheNearest) {
  Mesh mesh = test::boxMesh({0, 0, 0}, {10, 10, 10});
  PointCloud cloud;
  cloud.points.resize(2);
  cloud.points[0].rgb = {9, 8, 7};
  cloud.points[1].position = {10, 10, 10};
  cloud.points[1].rgb = {1, 2, 3};
  colourFromPoints(mesh, cloud);
  EXPECT_EQ(mesh.vertices[0].rgb, (Rgb{9, 8, 7}));
  EXPECT_EQ(mesh.vertices[7].rgb, (Rgb{1, 2, 3}));
}

}  // namespace
}  // namespace gyre
