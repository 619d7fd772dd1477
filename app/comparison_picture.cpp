// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/comparison_picture.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <utility>

#include <QBuffer>
#include <QByteArray>
#include <QFont>
#include <QImage>
#include <QPainter>
#include <opencv2/core/mat.hpp>

#include "app/screenless_application.h"
#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/io/atomic_file.h"
#include "core/pipeline/distance_colours.h"
#include "core/pipeline/model_picture.h"

namespace gyre {
namespace {

constexpr int kSide_px = 400;
constexpr int kMargin_px = 24;
constexpr int kTitle_px = 34;
constexpr int kFont_px = 18;
constexpr int kSmallFont_px = 14;
constexpr int kScaleHeight_px = 22;
constexpr int kHistogramHeight_px = 200;
constexpr int kTicks = 5;
constexpr double kElevation_rad = radFromDeg(15.0);
constexpr std::array<std::pair<const char*, double>, 4> kSides = {
    {{"front", 0.0}, {"right", 90.0}, {"back", 180.0}, {"left", 270.0}}};
constexpr int kWidth_px = 4 * kSide_px + 2 * kMargin_px;

QString words(const std::string& text) { return QString::fromStdString(text); }

void setFont(QPainter& painter, int pixels, QFont::Weight weight = QFont::Normal) {
  QFont font(QStringLiteral("DejaVu Sans"));
  font.setPixelSize(pixels);
  font.setWeight(weight);
  painter.setFont(font);
}

PointCloud cloudOf(const Mesh& mesh) {
  PointCloud cloud;
  cloud.points.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    Point point;
    point.position = vertex.position;
    point.normal = vertex.normal;
    point.rgb = vertex.rgb;
    cloud.points.push_back(std::move(point));
  }
  return cloud;
}

std::vector<cv::Mat> sidesOf(const Mesh& coloured, const Bounds& bounds) {
  std::vector<PosedCamera> views;
  views.reserve(kSides.size());
  for (const auto& [name, azimuth_deg] : kSides) {
    views.push_back(viewOf(bounds, radFromDeg(azimuth_deg), kElevation_rad, kSide_px));
  }
  if (!coloured.triangles.empty()) {
    return picturesOfSurface(coloured, views, SurfacePaint::kFigures);
  }
  const PointCloud cloud = cloudOf(coloured);
  std::vector<cv::Mat> pictures;
  pictures.reserve(views.size());
  for (const PosedCamera& view : views) {
    pictures.push_back(pictureOfPoints(cloud, view.intrinsics, view.cam_from_table));
  }
  return pictures;
}

void drawRow(QPainter& painter, const PaintedShape& painted, const Bounds& bounds, double scale_mm,
             int top_px) {
  setFont(painter, kFont_px, QFont::Bold);
  painter.drawText(kMargin_px, top_px, kWidth_px, kTitle_px, Qt::AlignVCenter,
                   words(painted.title));
  Mesh coloured = painted.shape;
  colourByDistance(coloured, painted.distances_mm, scale_mm);
  const std::vector<cv::Mat> sides = sidesOf(coloured, bounds);
  setFont(painter, kSmallFont_px);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const cv::Mat& side = sides[i];
    const QImage image(side.data, side.cols, side.rows, static_cast<int>(side.step),
                       QImage::Format_BGR888);
    const int left_px = kMargin_px + static_cast<int>(i) * kSide_px;
    painter.drawImage(left_px, top_px + 2 * kTitle_px, image);
    painter.drawText(left_px, top_px + kTitle_px, kSide_px, kTitle_px, Qt::AlignHCenter,
                     QString::fromLatin1(kSides[i].first));
  }
}

// Bars over the colours they stand for, the last one for all beyond the scale.
void drawHistogram(QPainter& painter, const Comparison& comparison, const QRect& place) {
  double most = 0.0;
  for (const ComparisonBin& bin : comparison.histogram) most = std::max(most, bin.share);
  const int bars = 1 + static_cast<int>(comparison.histogram.size());
  const double width_px = static_cast<double>(place.width()) / std::max(42, bars);
  for (std::size_t i = 0; i < comparison.histogram.size(); ++i) {
    const ComparisonBin& bin = comparison.histogram[i];
    const Rgb rgb = distanceColour(0.5 * (bin.from_mm + bin.to_mm), comparison.scale_mm);
    const bool beyond = bin.from_mm >= comparison.scale_mm;
    const double left_px =
        place.left() + width_px * (static_cast<double>(i) + (beyond ? 1.0 : 0.0));
    const double height_px = most > 0.0 ? bin.share / most * place.height() : 0.0;
    painter.fillRect(QRectF(left_px, place.bottom() - height_px, width_px - 1.0, height_px),
                     QColor(rgb[0], rgb[1], rgb[2]));
    if (!beyond) {
      painter.fillRect(QRectF(left_px, place.bottom() + 4, width_px + 0.5, kScaleHeight_px),
                       QColor(rgb[0], rgb[1], rgb[2]));
    } else {
      painter.drawText(QRectF(left_px - 30, place.bottom() - height_px - 22, 60 + width_px, 20),
                       Qt::AlignHCenter, words(formatted("%.1f %%", 100.0 * bin.share)));
      painter.drawText(QRectF(left_px - 40, place.bottom() + 28, 80 + width_px, 20),
                       Qt::AlignHCenter, QStringLiteral("more"));
    }
  }
  const double scale_px = width_px * 40.0;
  for (int i = 0; i <= kTicks; ++i) {
    const double at_px = place.left() + scale_px * i / kTicks;
    painter.drawLine(QPointF(at_px, place.bottom() + 4),
                     QPointF(at_px, place.bottom() + 8 + kScaleHeight_px));
    painter.drawText(QRectF(at_px - 60, place.bottom() + 28, 120, 24), Qt::AlignHCenter,
                     words(formatted("%.4g", comparison.scale_mm * i / kTicks)) +
                         (i == 0 ? QStringLiteral(" mm") : QString()));
  }
}

QByteArray pngOf(const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  return bytes;
}

}  // namespace

Result<void> writeComparisonPicture(const std::filesystem::path& file,
                                    const std::vector<PaintedShape>& shapes,
                                    const Comparison& comparison) {
  const ScreenlessApplication application;
  Bounds bounds;
  for (const PaintedShape& each : shapes) {
    const Bounds own = boundsOf(each.shape);
    bounds.include(own.min);
    bounds.include(own.max);
  }
  const int row_px = 2 * kTitle_px + kSide_px;
  const int top_px = kMargin_px + row_px * static_cast<int>(shapes.size());
  QImage image(kWidth_px, top_px + kTitle_px + kHistogramHeight_px + 80 + kMargin_px,
               QImage::Format_RGB888);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::black);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    drawRow(painter, shapes[i], bounds, comparison.scale_mm,
            kMargin_px + row_px * static_cast<int>(i));
  }
  setFont(painter, kFont_px, QFont::Bold);
  painter.drawText(kMargin_px, top_px, kWidth_px / 2, kTitle_px, Qt::AlignVCenter,
                   QStringLiteral("How often which distance occurs in the result"));
  setFont(painter, kSmallFont_px);
  drawHistogram(
      painter, comparison,
      QRect(kMargin_px + 10, top_px + kTitle_px + 24, kWidth_px / 2, kHistogramHeight_px - 24));
  setFont(painter, kFont_px);
  const int right_px = kMargin_px + 10 + kWidth_px / 2 + 60;
  painter.drawText(QRect(right_px, top_px + kTitle_px, kWidth_px - right_px - kMargin_px,
                         kHistogramHeight_px + 60),
                   Qt::TextWordWrap, words(comparisonText(comparison)));
  painter.end();
  const QByteArray png = pngOf(image);
  return writeFileAtomically(
      file, std::string_view(png.constData(), static_cast<std::size_t>(png.size())));
}

std::string comparisonText(const Comparison& comparison) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << "Distance to the reference: mean "
       << comparison.mean_mm << " mm, median " << comparison.median_mm << " mm, 95 % within "
       << comparison.p95_mm << " mm.";
  for (const ComparisonAt& at : comparison.at) {
    text << std::setprecision(3) << "\nWithin " << at.d_mm << " mm: precision "
         << std::setprecision(1) << 100.0 * at.precision << " %, completeness "
         << 100.0 * at.completeness << " %, F-score " << 100.0 * at.f << " %.";
  }
  return text.str();
}

}  // namespace gyre
