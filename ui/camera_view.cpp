// The live picture, with the features that are followed in it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/camera_view.h"

#include <algorithm>
#include <array>
#include <utility>

#include <QMouseEvent>
#include <QPainter>

namespace gyre {
namespace {

// Enough to tell where a feature comes from; more would hide the object.
constexpr std::size_t kTailViews = 3;
constexpr int kTailAlpha = 90;

const QColor kGoodMark(70, 225, 130);
const QColor kBadMark(255, 90, 70);
const QColor kArrowMark(60, 190, 255);

struct MarkStyle {
  QColor colour;
  int dot_px;
};

MarkStyle styleOf(FeatureState state) {
  switch (state) {
    case FeatureState::kNew:
      return {QColor(235, 240, 245), 1};
    case FeatureState::kTracked:
      return {QColor(255, 200, 60), 2};
    case FeatureState::kMeasured:
      return {QColor(70, 225, 130), 2};
  }
  return {};
}

// Shares the pixels of the frame, which must outlive the image.
QImage imageOf(const Frame& frame) {
  const cv::Mat& mat = frame.image_bgr;
  return {mat.data, mat.cols, mat.rows, static_cast<qsizetype>(mat.step[0]), QImage::Format_BGR888};
}

}  // namespace

CameraView::CameraView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(240, 180);
  setAccessibleName(tr("Live picture of the camera"));
  setAttribute(Qt::WA_OpaquePaintEvent);
  clear(tr("No camera yet"));
}

void CameraView::showFrame(const FramePtr& frame) {
  frame_ = frame;
  tracked_.reset();
  rebuild();
}

void CameraView::showTrackedFrame(const TrackedFramePtr& tracked) {
  tracked_ = tracked;
  frame_ = tracked ? tracked->frame : nullptr;
  rebuild();
}

void CameraView::setOverlay(std::vector<PictureMark> overlay) {
  overlay_ = std::move(overlay);
  rebuild();
}

void CameraView::clear(const QString& why) {
  words_ = why;
  frame_.reset();
  tracked_.reset();
  rebuild();
}

QRectF CameraView::pictureArea() const {
  if (!frame_) return {};
  const QSizeF picture(frame_->image_bgr.cols, frame_->image_bgr.rows);
  const QSizeF fitted = picture.scaled(size(), Qt::KeepAspectRatio);
  return {QPointF(0.5 * (width() - fitted.width()), 0.5 * (height() - fitted.height())), fitted};
}

// Scales once a frame, not once a paint.
void CameraView::rebuild() {
  drawn_ = {};
  update();
  const QSize device_size = (pictureArea().size() * devicePixelRatioF()).toSize();
  if (!frame_ || device_size.isEmpty()) return;
  drawn_ = QPixmap(device_size);
  QPainter painter(&drawn_);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(QRectF(QPointF(), device_size), imageOf(*frame_));
  const double scale = device_size.width() / static_cast<double>(frame_->image_bgr.cols);
  paintMarks(painter, scale);
  paintOverlay(painter, scale);
}

void CameraView::paintMarks(QPainter& painter, double scale) const {
  if (!tracked_) return;
  for (const FeatureState state :
       {FeatureState::kNew, FeatureState::kTracked, FeatureState::kMeasured}) {
    const MarkStyle style = styleOf(state);
    const int dot_px = std::max(1, qRound(style.dot_px * devicePixelRatioF()));
    std::vector<QLineF> tails;
    std::vector<QRectF> dots;
    for (const FeatureMark& mark : tracked_->marks) {
      if (mark.state != state) continue;
      // The centre of the first pixel is (0, 0), half a pixel from the picture's corner.
      const auto at = [&](const Eigen::Vector2f& pixel) {
        return QPointF((pixel.x() + 0.5) * scale, (pixel.y() + 0.5) * scale);
      };
      const std::size_t oldest = mark.tail.size() > kTailViews ? mark.tail.size() - kTailViews : 0;
      for (std::size_t i = oldest + 1; i < mark.tail.size(); ++i) {
        tails.emplace_back(at(mark.tail[i - 1]), at(mark.tail[i]));
      }
      const QPointF head = at(mark.tail.back());
      dots.emplace_back(head.x() - 0.5 * dot_px, head.y() - 0.5 * dot_px, dot_px, dot_px);
    }
    QColor faint = style.colour;
    faint.setAlpha(kTailAlpha);
    painter.setPen(QPen(faint, 0));
    painter.drawLines(tails.data(), static_cast<int>(tails.size()));
    for (const QRectF& dot : dots) painter.fillRect(dot, style.colour);
  }
}

void CameraView::paintOverlay(QPainter& painter, double scale) const {
  painter.setRenderHint(QPainter::Antialiasing);
  const double radius = 4.0 * devicePixelRatioF();
  const double line = 1.5 * devicePixelRatioF();
  for (const PictureMark& mark : overlay_) {
    const QPointF at((mark.at_px.x() + 0.5) * scale, (mark.at_px.y() + 0.5) * scale);
    switch (mark.shape) {
      case PictureMark::Shape::kCircle:
        painter.setPen(QPen(kGoodMark, line));
        painter.drawEllipse(at, radius, radius);
        break;
      case PictureMark::Shape::kCross:
        painter.setPen(QPen(kBadMark, line));
        painter.drawLine(at + QPointF(-radius, -radius), at + QPointF(radius, radius));
        painter.drawLine(at + QPointF(-radius, radius), at + QPointF(radius, -radius));
        break;
      case PictureMark::Shape::kArrow: {
        const QPointF to((mark.to_px.x() + 0.5) * scale, (mark.to_px.y() + 0.5) * scale);
        painter.setPen(QPen(kArrowMark, line));
        painter.drawLine(at, to);
        painter.drawEllipse(at, 0.3 * radius, 0.3 * radius);
        break;
      }
      case PictureMark::Shape::kLine:
        painter.setPen(QPen(kArrowMark, line));
        painter.drawLine(at, {(mark.to_px.x() + 0.5) * scale, (mark.to_px.y() + 0.5) * scale});
        break;
    }
  }
}

void CameraView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Window));
  if (drawn_.isNull()) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect().adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap, words_);
    return;
  }
  painter.drawPixmap(pictureArea(), drawn_, QRectF(drawn_.rect()));
}

void CameraView::resizeEvent(QResizeEvent*) { rebuild(); }

void CameraView::setPicking(bool picking) {
  picking_ = picking;
  if (picking) {
    setCursor(Qt::CrossCursor);
  } else {
    unsetCursor();
  }
}

void CameraView::mousePressEvent(QMouseEvent* event) {
  const QRectF area = pictureArea();
  if (!picking_ || !area.contains(event->position())) {
    QWidget::mousePressEvent(event);
    return;
  }
  const double picture_per_widget = frame_->image_bgr.cols / area.width();
  const QPointF at = (event->position() - area.topLeft()) * picture_per_widget;
  Q_EMIT picked({at.x() - 0.5, at.y() - 0.5});
}

}  // namespace gyre
