// The 3D view: the growing cloud or the mesh, on the table, with the camera around it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <vtkRenderWindow.h>

#include "ui/scene_actors.h"
#include "ui/scene_canvas.h"
#include "ui/scene_overlay.h"

namespace gyre {

SceneView::SceneView(QWidget* parent) : QWidget(parent), actors_(std::make_unique<SceneActors>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  canvas_ = makeSceneCanvas(this);
  if (canvas_ == nullptr) {
    auto* text =
        new QLabel(tr("This computer offers no OpenGL 3.2, so the 3D view stays empty. "
                      "Scanning and exporting work all the same."));
    text->setWordWrap(true);
    text->setAlignment(Qt::AlignCenter);
    layout->addWidget(text);
    return;
  }
  canvas_->widget()->setObjectName("canvas");
  layout->addWidget(canvas_->widget());
  overlay_ = new SceneOverlay(this);
  actors_->addTo(*canvas_->window());
  canvas_->widget()->setFocusPolicy(Qt::StrongFocus);
  canvas_->widget()->setAccessibleName(tr("3D view of the scan"));
  canvas_->widget()->setToolTip(
      tr("Drag to turn, Shift+drag to move, wheel to zoom. Keys 1–6: views, 7: the whole rig, F: "
         "fit."));
  canvas_->widget()->installEventFilter(this);
  fill_timer_.setSingleShot(true);
  connect(&fill_timer_, &QTimer::timeout, this, &SceneView::fillCloud);
  rest_timer_.setSingleShot(true);
  rest_timer_.setInterval(250);
  connect(&rest_timer_, &QTimer::timeout, this, &SceneView::endMotion);
  camera_.fit(actors_->objectBounds());
  camera_.zoom(0.85);  // some room for the camera that goes round
  followTheme();
}

SceneView::~SceneView() = default;

QImage SceneView::picture() {
  if (canvas_ == nullptr) return {};
  while (actors_->cloud().fillNext()) continue;
  redraw();
  return canvas_->picture();
}

void SceneView::showCloud(const PointCloudPtr& cloud) {
  cloud_ = cloud;
  if (canvas_ == nullptr) return;
  actors_->cloud().show(cloud, colours_);
  fill_timer_.start(0);
}

// One piece each time the event loop comes round: input is served in between.
void SceneView::fillCloud() {
  if (actors_->cloud().fillNext()) fill_timer_.start(0);
  redraw();
}

void SceneView::showMesh(const MeshPtr& mesh) {
  if (canvas_ == nullptr || mesh == mesh_) return;
  mesh_ = mesh;
  actors_->showMesh(mesh);
  redraw();
}

void SceneView::showCalibration(const Calibration& calibration) {
  actors_->rig().showCamera(calibration);
  redraw();
}

void SceneView::showTableAngleRad(double angle_rad) {
  actors_->rig().setTableAngleRad(angle_rad);
  redraw();
}

void SceneView::showUsable(const std::optional<UsableCylinder>& cylinder) {
  actors_->rig().showUsable(cylinder);
  redraw();
}

void SceneView::showTarget(const Target& target, const Rigid3& table_from_target) {
  if (canvas_ == nullptr) return;
  actors_->target().show(target, table_from_target);
  redraw();
}

void SceneView::hideTarget() {
  if (canvas_ == nullptr) return;
  actors_->target().hide();
  redraw();
}

void SceneView::setColours(CloudColours colours) {
  colours_ = colours;
  showCloud(cloud_);
}

void SceneView::showCrop(const CropOptions& crop) {
  if (canvas_ == nullptr) return;
  actors_->crop().show(crop, actors_->objectBounds());
  redraw();
}

void SceneView::setHatching(Hatching hatching) {
  actors_->mesh().setHatching(hatching);
  redraw();
}

void SceneView::setUnseenShare(double share) {
  unseen_share_ = share;
  redraw();
}

void SceneView::setPicking(Picking picking) {
  picking_ = picking;
  if (canvas_ == nullptr) return;
  if (picking == Picking::kOn) {
    canvas_->widget()->setCursor(Qt::CrossCursor);
  } else {
    canvas_->widget()->unsetCursor();
  }
}

void SceneView::showLines(std::vector<SceneLine> lines) {
  lines_ = std::move(lines);
  redraw();
}

void SceneView::lookFrom(ViewSide side) {
  camera_.lookFrom(side);
  redraw();
}

void SceneView::fit() {
  camera_.fit(actors_->objectBounds());
  redraw();
}

void SceneView::fitRig() {
  camera_.fit(actors_->rigBounds());
  redraw();
}

void SceneView::redraw() {
  if (canvas_ == nullptr) return;
  actors_->lookThrough(camera_);
  overlay_->setScale(camera_.viewHeightMm(), colours_ == CloudColours::kUncertainty
                                                 ? actors_->cloud().worstShownSigmaMm()
                                                 : 0.0);
  actors_->mesh().setPixelRatio(devicePixelRatioF());
  overlay_->setUnseenShare(actors_->mesh().hatches() ? unseen_share_ : 0.0);
  const auto seen_at = [this](const Eigen::Vector3d& position) {
    const Eigen::Vector2d at = camera_.seenAt(position);
    return QPointF(0.5 * width() + at.x() * height(), 0.5 * height() + at.y() * height());
  };
  std::vector<OverlayLine> lines;
  lines.reserve(lines_.size());
  for (const SceneLine& line : lines_) {
    lines.push_back({seen_at(line.from), seen_at(line.to), line.text});
  }
  overlay_->setLines(std::move(lines));
  canvas_->requestRender();
}

void SceneView::followTheme() {
  if (canvas_ == nullptr) return;
  const bool dark = palette().color(QPalette::Window).lightness() < 128;
  actors_->setTheme(dark ? SceneTheme::kDark : SceneTheme::kLight);
  redraw();
}

void SceneView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) followTheme();
  QWidget::changeEvent(event);
}

void SceneView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  if (overlay_ == nullptr) return;
  overlay_->setGeometry(rect());
  overlay_->raise();
  redraw();
}

bool SceneView::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      last_mouse_ = static_cast<QMouseEvent*>(event)->position();
      pressed_at_ = last_mouse_;
      return false;  // the canvas takes the focus
    case QEvent::MouseButtonRelease:
      if (static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton) {
        click(static_cast<QMouseEvent*>(event)->position());
      }
      return false;
    case QEvent::MouseMove:
      drag(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::Wheel:
      wheel(*static_cast<QWheelEvent*>(event));
      return true;
    case QEvent::KeyPress:
      if (key(static_cast<QKeyEvent*>(event)->key())) return true;
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

// A press and a release at one place; what is dragged between them turns the view.
void SceneView::click(const QPointF& at) {
  constexpr double kStill_px = 4.0;
  if (picking_ == Picking::kOff) return;
  if (std::hypot(at.x() - pressed_at_.x(), at.y() - pressed_at_.y()) > kStill_px) return;
  const double ratio = devicePixelRatioF();
  if (const auto pick = actors_->pick({ratio * at.x(), ratio * (height() - 1.0 - at.y())})) {
    Q_EMIT picked(*pick);
  }
}

void SceneView::drag(const QMouseEvent& event) {
  const QPointF moved = (event.position() - last_mouse_) / std::max(height(), 1);
  last_mouse_ = event.position();
  const bool left = event.buttons().testFlag(Qt::LeftButton);
  const bool pans = event.buttons().testFlag(Qt::MiddleButton) ||
                    (left && event.modifiers().testFlag(Qt::ShiftModifier));
  if (!left && !pans) return;
  if (pans) {
    camera_.pan(moved.x(), moved.y());
  } else {
    camera_.rotate(moved.x(), moved.y());
  }
  beginMotion();
  redraw();
}

void SceneView::wheel(const QWheelEvent& event) {
  constexpr double kNotch = 120.0;  // eighths of a degree, by Qt's convention
  camera_.zoom(std::pow(1.15, event.angleDelta().y() / kNotch));
  beginMotion();
  redraw();
}

bool SceneView::key(int key) {
  switch (key) {
    case Qt::Key_1:
      lookFrom(ViewSide::kFront);
      return true;
    case Qt::Key_2:
      lookFrom(ViewSide::kBack);
      return true;
    case Qt::Key_3:
      lookFrom(ViewSide::kLeft);
      return true;
    case Qt::Key_4:
      lookFrom(ViewSide::kRight);
      return true;
    case Qt::Key_5:
      lookFrom(ViewSide::kTop);
      return true;
    case Qt::Key_6:
      lookFrom(ViewSide::kIso);
      return true;
    case Qt::Key_7:
      fitRig();
      return true;
    case Qt::Key_F:
      fit();
      return true;
    default:
      return false;
  }
}

void SceneView::beginMotion() {
  rest_timer_.start();
  if (!canvas_->rendersInSoftware()) return;
  actors_->cloud().setDetail(CloudDetail::kThinned);
  fill_timer_.start(0);
}

void SceneView::endMotion() {
  actors_->cloud().setDetail(CloudDetail::kFull);
  fill_timer_.start(0);
}

}  // namespace gyre
