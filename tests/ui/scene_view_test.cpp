// The 3D view shows the right pixels: its worst failure is silent.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_view.h"

#include <gtest/gtest.h>

#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "core/base/random.h"
#include "tests/support/qt_application.h"

namespace gyre {
namespace {

constexpr QRgb kRed = 0xffff0000;
constexpr QRgb kBlue = 0xff0000ff;

PointCloudPtr blocks(double spread_mm) {
  // Two dense balls of points: a red one on the left in the front view (-y... +y), a blue one
  // right.
  auto cloud = std::make_shared<PointCloud>();
  Random random(7);
  for (int i = 0; i < 4000; ++i) {
    Point point;
    const bool red = i % 2 == 0;
    point.position = {random.uniform(-8, 8), (red ? -spread_mm : spread_mm) + random.uniform(-8, 8),
                      40.0 + random.uniform(-8, 8)};
    point.rgb = red ? Rgb{255, 0, 0} : Rgb{0, 0, 255};
    point.covariance.setIdentity();
    point.covariance *= red ? 1e-6 : 1.0;
    cloud->points.push_back(point);
  }
  return cloud;
}

// Mean place of the pixels of a colour, as shares of width and height, and how many there are.
struct Patch {
  double x = 0.0;
  double y = 0.0;
  int pixels = 0;
};
Patch find(const QImage& image, QRgb colour) {
  Patch patch;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if ((image.pixel(x, y) | 0xff000000) != colour) continue;
      patch.x += x;
      patch.y += y;
      ++patch.pixels;
    }
  }
  if (patch.pixels > 0) {
    patch.x /= patch.pixels * static_cast<double>(image.width());
    patch.y /= patch.pixels * static_cast<double>(image.height());
  }
  return patch;
}

class SceneViewTest : public testing::Test {
 protected:
  void SetUp() override {
    view_.resize(400, 300);
    view_.lookFrom(ViewSide::kFront);
    view_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view_));
    ASSERT_TRUE(view_.works());
  }
  // As a person sees it: through the widget, not through VTK.
  QImage seen() {
    view_.picture();
    return view_.grab().toImage();
  }
  void drag(Qt::MouseButton button, QPointF by) {
    QWidget* canvas = view_.findChild<QWidget*>("canvas");
    ASSERT_NE(canvas, nullptr);
    const QPointF start(200, 150);
    QMouseEvent press(QEvent::MouseButtonPress, start, start, button, button, Qt::NoModifier);
    QMouseEvent move(QEvent::MouseMove, start + by, start + by, Qt::NoButton, button,
                     Qt::NoModifier);
    QCoreApplication::sendEvent(canvas, &press);
    QCoreApplication::sendEvent(canvas, &move);
  }
  SceneView view_;
};

TEST_F(SceneViewTest, ShowsKnownPointsWhereTheyBelong) {
  view_.showCloud(blocks(30.0));
  const QImage image = seen();
  const Patch red = find(image, kRed);
  const Patch blue = find(image, kBlue);
  EXPECT_GT(red.pixels, 300);
  EXPECT_GT(blue.pixels, 300);
  EXPECT_LT(red.x, 0.45);  // seen from +x with z up, +y is on the right
  EXPECT_GT(blue.x, 0.55);
  EXPECT_NEAR(red.x + blue.x, 1.0, 0.03);
  EXPECT_NEAR(red.y, blue.y, 0.03);
}

TEST_F(SceneViewTest, ShowsNothingOfTheCloudBeforeItComes) {
  EXPECT_EQ(find(seen(), kRed).pixels, 0);
}

TEST_F(SceneViewTest, ReplacesTheCloudByTheNext) {
  view_.showCloud(blocks(30.0));
  seen();
  view_.showCloud(std::make_shared<PointCloud>());
  EXPECT_EQ(find(seen(), kRed).pixels, 0);
}

TEST_F(SceneViewTest, ShowsCloudsOfManyPiecesWhole) {
  auto cloud = std::make_shared<PointCloud>();
  Point point;
  point.position = {0.0, -30.0, 40.0};
  point.rgb = {255, 0, 0};
  cloud->points.assign(70000, point);
  point.position = {0.0, 30.0, 40.0};
  point.rgb = {0, 0, 255};
  cloud->points.push_back(point);  // alone in the second piece
  view_.showCloud(cloud);
  EXPECT_GE(find(seen(), kBlue).pixels, 4);
}

TEST_F(SceneViewTest, TurnsByDragging) {
  view_.showCloud(blocks(30.0));
  const Patch before = find(seen(), kRed);
  drag(Qt::LeftButton, {300, 0});  // a whole height is half a turn
  const Patch after = find(seen(), kRed);
  EXPECT_LT(before.x, 0.45);
  EXPECT_GT(after.x, 0.55);
}

TEST_F(SceneViewTest, MovesByMiddleDrag) {
  view_.showCloud(blocks(30.0));
  const Patch before = find(seen(), kBlue);
  drag(Qt::MiddleButton, {0, -60});
  const Patch after = find(seen(), kBlue);
  EXPECT_NEAR(before.y - after.y, 0.2, 0.03);
  EXPECT_NEAR(before.x, after.x, 0.02);
}

TEST_F(SceneViewTest, ColoursByUncertainty) {
  view_.showCloud(blocks(30.0));
  view_.setColours(CloudColours::kUncertainty);
  const QImage image = seen();
  const Rgb best = uncertaintyColour(0.001);
  const Rgb worst = uncertaintyColour(1.0);
  EXPECT_EQ(find(image, kRed).pixels, 0);
  EXPECT_GT(find(image, qRgb(best[0], best[1], best[2])).pixels, 300);
  EXPECT_GT(find(image, qRgb(worst[0], worst[1], worst[2])).pixels, 300);
}

TEST_F(SceneViewTest, ShowsTheMeshInPlaceOfTheCloud) {
  view_.showCloud(blocks(30.0));
  auto mesh = std::make_shared<Mesh>();
  for (const auto& corner : {Eigen::Vector3d(5, -20, 10), {5, 20, 10}, {5, 0, 60}}) {
    MeshVertex vertex;
    vertex.position = corner;
    vertex.normal = {1, 0, 0};
    vertex.rgb = {0, 255, 0};
    mesh->vertices.push_back(vertex);
  }
  mesh->triangles.push_back({0, 1, 2});
  view_.showMesh(mesh);
  const QImage image = seen();
  EXPECT_EQ(find(image, kRed).pixels, 0);
  const QColor centre = image.pixelColor(200, 150);
  EXPECT_GT(centre.green(), 150);
  EXPECT_LT(centre.red(), 60);
}

// An upright triangle in the front view, of one colour; seen or not.
MeshPtr triangle(std::uint8_t seen) {
  auto mesh = std::make_shared<Mesh>();
  for (const auto& corner : {Eigen::Vector3d(5, -20, 10), {5, 20, 10}, {5, 0, 60}}) {
    MeshVertex vertex;
    vertex.position = corner;
    vertex.normal = {1, 0, 0};
    vertex.rgb = {0, 255, 0};
    vertex.seen = seen;
    mesh->vertices.push_back(vertex);
  }
  mesh->triangles.push_back({0, 1, 2});
  return mesh;
}

int greenPixels(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor colour = image.pixelColor(x, y);
      if (colour.green() > 150 && colour.red() < 60 && colour.blue() < 60) ++count;
    }
  }
  return count;
}

TEST_F(SceneViewTest, HatchesWhatNoCameraSawAndOnlyThat) {
  view_.showMesh(triangle(1));
  const QImage seen_image = seen();
  const int whole = greenPixels(seen_image);
  view_.showMesh(triangle(0));
  const int between_stripes = greenPixels(seen());
  EXPECT_GT(whole, 500);
  EXPECT_NEAR(static_cast<double>(between_stripes) / whole, 0.5, 0.1);
  view_.setHatching(Hatching::kHidden);
  EXPECT_EQ(greenPixels(seen()), whole);
  view_.setHatching(Hatching::kShown);
  EXPECT_EQ(greenPixels(seen()), between_stripes);
}

TEST_F(SceneViewTest, ExplainsTheHatchingOnlyWhereThereIsSome) {
  view_.showMesh(triangle(1));
  view_.setUnseenShare(0.0);
  const QImage without = seen();
  view_.showMesh(triangle(0));
  view_.setHatching(Hatching::kHidden);
  EXPECT_EQ(seen(), without);
  view_.setUnseenShare(0.3);
  EXPECT_EQ(seen(), without);
  view_.setHatching(Hatching::kShown);
  EXPECT_NE(seen().copy(0, 0, 40, 40), without.copy(0, 0, 40, 40));
}

TEST_F(SceneViewTest, TellsWhichPlaceOfTheMeshWasClicked) {
  qRegisterMetaType<ScenePick>();
  view_.showMesh(triangle(1));
  seen();
  QSignalSpy picked(&view_, &SceneView::picked);
  QWidget* canvas = view_.findChild<QWidget*>("canvas");
  QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, {200, 150});
  EXPECT_EQ(picked.count(), 0);  // not asked for
  view_.setPicking(Picking::kOn);
  QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, {200, 150});
  ASSERT_EQ(picked.count(), 1);
  const auto pick = picked.front().front().value<ScenePick>();
  EXPECT_EQ(pick.on, ScenePick::On::kTriangle);
  EXPECT_EQ(pick.index, 0U);
  EXPECT_NEAR(pick.position.x(), 5.0, 1e-3);
  EXPECT_NEAR(pick.position.y(), 0.0, 1.0);
  QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, {5, 5});  // beside the object
  EXPECT_EQ(picked.count(), 1);
}

TEST_F(SceneViewTest, DrawsAMeasuredLineWhereItsEndsAreSeen) {
  view_.showMesh(triangle(1));
  QSignalSpy picked(&view_, &SceneView::picked);
  view_.setPicking(Picking::kOn);
  seen();
  QWidget* canvas = view_.findChild<QWidget*>("canvas");
  for (const QPoint& at : {QPoint(190, 160), QPoint(212, 150)}) {
    QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, at);
  }
  ASSERT_EQ(picked.count(), 2);
  const QImage before = seen();
  view_.showLines({{picked[0].front().value<ScenePick>().position,
                    picked[1].front().value<ScenePick>().position, ""}});
  const QImage drawn = seen();
  EXPECT_NE(drawn.pixel(190, 160), before.pixel(190, 160));
  EXPECT_NE(drawn.pixel(212, 150), before.pixel(212, 150));
  EXPECT_EQ(drawn.pixel(230, 120), before.pixel(230, 120));
  view_.showLines({});
  EXPECT_EQ(seen(), before);
}

TEST_F(SceneViewTest, PicksPointsWhileTheCloudIsShown) {
  const PointCloudPtr cloud = blocks(30.0);
  view_.showCloud(cloud);
  const Patch red = find(seen(), kRed);
  view_.setPicking(Picking::kOn);
  QSignalSpy picked(&view_, &SceneView::picked);
  QTest::mouseClick(view_.findChild<QWidget*>("canvas"), Qt::LeftButton, Qt::NoModifier,
                    {static_cast<int>(400 * red.x), static_cast<int>(300 * red.y)});
  ASSERT_EQ(picked.count(), 1);
  const auto pick = picked.front().front().value<ScenePick>();
  EXPECT_EQ(pick.on, ScenePick::On::kPoint);
  ASSERT_LT(pick.index, cloud->points.size());
  EXPECT_EQ(pick.index % 2, 0U);  // a red one
  EXPECT_EQ(pick.position, cloud->points[pick.index].position);
}

TEST_F(SceneViewTest, TurnsAndPicksNothingWhenTheMouseIsDragged) {
  view_.showMesh(triangle(1));
  seen();
  view_.setPicking(Picking::kOn);
  QSignalSpy picked(&view_, &SceneView::picked);
  QWidget* canvas = view_.findChild<QWidget*>("canvas");
  QTest::mousePress(canvas, Qt::LeftButton, Qt::NoModifier, {200, 150});
  QTest::mouseRelease(canvas, Qt::LeftButton, Qt::NoModifier, {215, 150});
  EXPECT_EQ(picked.count(), 0);
}

TEST_F(SceneViewTest, DrawsTheCropAndTakesItAway) {
  view_.showMesh(triangle(1));
  const QImage before = seen();
  CropOptions crop;
  crop.radius_mm = 15.0;
  view_.showCrop(crop);
  const QImage cylinder = seen();
  EXPECT_NE(cylinder, before);
  crop.z_max_mm = 40.0;
  view_.showCrop(crop);
  EXPECT_NE(seen(), cylinder);
  view_.showCrop({});
  EXPECT_EQ(seen(), before);
}

TEST_F(SceneViewTest, FitsASmallObject) {
  view_.showCloud(blocks(10.0));
  const int before = find(seen(), kRed).pixels;
  view_.fit();
  EXPECT_GT(find(seen(), kRed).pixels, 2 * before);
}

TEST_F(SceneViewTest, ShowsTheWholeRigWithItsCamera) {
  constexpr QRgb kCamera = qRgb(230, 140, 46);
  Calibration calibration;
  calibration.camera = {640, 480, 1200.0, 1200.0, 0.0, 319.5, 239.5};
  // 900 mm off along x, out of sight, looking back at the axis: cam z = -x, cam y = -z of the
  // table.
  Rigid3 cam_from_table;
  cam_from_table.rotation << 0, 1, 0, 0, 0, -1, -1, 0, 0;
  cam_from_table.translation = {0.0, 20.0, 900.0};
  calibration.cam_from_table = cam_from_table;
  view_.showCalibration(calibration);
  view_.fit();
  const int before = find(seen(), kCamera).pixels;
  view_.fitRig();
  EXPECT_GT(find(seen(), kCamera).pixels, before + 20);
}

TEST_F(SceneViewTest, ShowsATargetAndTakesItAway) {
  Target target;
  target.markers = {{0,
                     {Eigen::Vector3d(-30, -30, 5), Eigen::Vector3d(-30, 30, 5),
                      Eigen::Vector3d(30, 30, 5), Eigen::Vector3d(30, -30, 5)}}};
  target.corners = {{0, {0.0, 0.0, 40.0}}};
  const QImage before = seen();
  view_.showTarget(target, {});
  EXPECT_NE(seen(), before);
  view_.hideTarget();
  EXPECT_EQ(seen(), before);
}

}  // namespace
}  // namespace gyre
