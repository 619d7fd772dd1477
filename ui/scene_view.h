// The 3D view: the growing cloud or the mesh, on the table, with the camera around it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <QTimer>
#include <QWidget>

#include "core/mesh/clean/options.h"
#include "core/scan/calibration.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"
#include "core/scan/target.h"
#include "core/scan/usable_cylinder.h"
#include "ui/cloud_actors.h"
#include "ui/mesh_actor.h"
#include "ui/scene_camera.h"
#include "ui/scene_pick.h"

class QMouseEvent;
class QWheelEvent;

namespace gyre {

class SceneActors;
class SceneCanvas;
class SceneOverlay;

// Left drag turns the view, middle or Shift+left drag moves it, the wheel zooms. Keys: 1 front,
// 2 back, 3 left, 4 right, 5 top, 6 oblique, 7 the whole rig with its camera, F fit.
class SceneView final : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  // False on a machine that can draw no 3D at all; the view then says so.
  bool works() const { return canvas_ != nullptr; }
  // What is seen now, in device pixels; null when it does not work.
  QImage picture();

 public Q_SLOTS:
  void showCloud(const gyre::PointCloudPtr& cloud);
  void showMesh(const gyre::MeshPtr& mesh);  // null: the cloud again
  void showCalibration(const gyre::Calibration& calibration);
  void showTableAngleRad(double angle_rad);
  void showUsable(const std::optional<gyre::UsableCylinder>& cylinder);  // nothing hides it
  void showTarget(const gyre::Target& target, const gyre::Rigid3& table_from_target);
  void hideTarget();
  void setColours(gyre::CloudColours colours);
  void showCrop(const gyre::CropOptions& crop);  // where it cuts; at its limits: nothing
  void setHatching(gyre::Hatching hatching);
  void setUnseenShare(double share);  // of the mesh's area, for the legend. [0, 1]
  void setPicking(gyre::Picking picking);
  void showLines(std::vector<gyre::SceneLine> lines);
  void lookFrom(gyre::ViewSide side);
  void fit();
  void fitRig();

 Q_SIGNALS:
  void picked(const gyre::ScenePick& pick);  // a click while picking is on; never beside the object

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void redraw();
  void fillCloud();
  void followTheme();
  void drag(const QMouseEvent& event);
  void wheel(const QWheelEvent& event);
  bool key(int key);
  void click(const QPointF& at);
  void beginMotion();
  void endMotion();

  SceneCanvas* canvas_ = nullptr;  // a child of this
  SceneOverlay* overlay_ = nullptr;
  std::unique_ptr<SceneActors> actors_;
  SceneCamera camera_;
  PointCloudPtr cloud_;
  MeshPtr mesh_;  // null while the cloud is shown
  CloudColours colours_ = CloudColours::kNatural;
  QTimer fill_timer_;
  QTimer rest_timer_;
  QPointF last_mouse_;
  QPointF pressed_at_;
  Picking picking_ = Picking::kOff;
  double unseen_share_ = 0.0;
  std::vector<SceneLine> lines_;
};

}  // namespace gyre
