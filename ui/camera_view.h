// The live picture, with the features that are followed in it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include <QPixmap>
#include <QWidget>

#include "core/scan/tracked_frame.h"

namespace gyre {

using TrackedFramePtr = std::shared_ptr<const TrackedFrame>;

// Something to point at in the picture. The shapes differ as well as the colours.
struct PictureMark {
  enum class Shape { kCircle, kCross, kArrow, kLine };
  Shape shape = Shape::kCircle;
  Eigen::Vector2f at_px = Eigen::Vector2f::Zero();  // raw picture coordinates
  Eigen::Vector2f to_px = Eigen::Vector2f::Zero();  // of an arrow: its tip; of a line: its end
};

// Shows the whole picture, as large as fits. Features are dots with tails of the last views:
// white seen once, yellow followed, green measured; what is seen once has the smaller dot.
class CameraView final : public QWidget {
  Q_OBJECT

 public:
  explicit CameraView(QWidget* parent = nullptr);

  QSize sizeHint() const override { return {480, 360}; }

 public Q_SLOTS:
  void showFrame(const gyre::FramePtr& frame);
  void showTrackedFrame(const gyre::TrackedFramePtr& tracked);
  // Laid over this and all coming pictures until other ones are given.
  void setOverlay(std::vector<gyre::PictureMark> overlay);
  void clear(const QString& why);  // shows the words in place of a picture
  // While a point of the picture is asked for, the pointer is a cross and clicks are told.
  void setPicking(bool picking);

 Q_SIGNALS:
  void picked(const Eigen::Vector2d& pixel);  // raw picture coordinates

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  QRectF pictureArea() const;
  void rebuild();
  void paintMarks(QPainter& painter, double scale) const;
  void paintOverlay(QPainter& painter, double scale) const;

  FramePtr frame_;
  TrackedFramePtr tracked_;
  std::vector<PictureMark> overlay_;
  QString words_;
  bool picking_ = false;
  QPixmap drawn_;  // picture and marks in device pixels of the picture's area
};

}  // namespace gyre
