// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/print_target.h"

#include <QBuffer>
#include <QByteArray>
#include <QFont>
#include <QMarginsF>
#include <QPageLayout>
#include <QPageSize>
#include <QPainter>
#include <QPainterPath>
#include <QPdfWriter>

#include "app/screenless_application.h"
#include "core/io/atomic_file.h"
#include "core/io/target_file.h"

namespace gyre {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr int kDotsPerInch = 1200;

QPen penFor(PrintLine::Kind kind) {
  switch (kind) {
    case PrintLine::Kind::kCut:
    case PrintLine::Kind::kFlap:
      return QPen(Qt::black, 0.18);
    case PrintLine::Kind::kFold: {
      QPen pen(QColor(120, 120, 120), 0.18);
      pen.setDashPattern({8.0, 6.0});  // in widths of the line
      pen.setCapStyle(Qt::FlatCap);
      return pen;
    }
    case PrintLine::Kind::kRuler:
      break;
  }
  QPen pen(Qt::black, 0.12);
  pen.setCapStyle(Qt::FlatCap);
  return pen;
}

// All of one colour in one path: neighbours that touch leave no seam.
void paintPolygons(const PrintDrawing& sheet, PrintPolygon::Ink ink, QPainter& painter) {
  QPainterPath path;
  path.setFillRule(Qt::WindingFill);
  for (const PrintPolygon& polygon : sheet.polygons) {
    if (polygon.ink != ink) continue;
    QPolygonF outline;
    for (const Eigen::Vector2d& point : polygon.outline) outline << QPointF(point.x(), point.y());
    path.addPolygon(outline);
    path.closeSubpath();
  }
  painter.fillPath(path, ink == PrintPolygon::Ink::kBlack ? Qt::black : Qt::white);
}

double heightOf(PrintText::Style style) {
  switch (style) {
    case PrintText::Style::kTitle:
      return 5.5;
    case PrintText::Style::kPlain:
      return 3.4;
    case PrintText::Style::kSmall:
      break;
  }
  return 2.8;
}

// The painter's unit is a millimetre, which is too coarse for fonts: text is set a hundred times
// as large and drawn that much smaller.
void paintText(const PrintText& text, QPainter& painter) {
  constexpr double kFiner = 100.0;
  QFont font(QStringLiteral("DejaVu Sans"));
  font.setPixelSize(static_cast<int>(kFiner * heightOf(text.style)));
  font.setBold(text.style == PrintText::Style::kTitle);
  painter.save();
  painter.translate(text.top_left.x(), text.top_left.y());
  painter.scale(1.0 / kFiner, 1.0 / kFiner);
  painter.setFont(font);
  painter.setPen(Qt::black);
  const int align = text.align == PrintText::Align::kCentre ? Qt::AlignHCenter : Qt::AlignLeft;
  painter.drawText(QRectF(0.0, 0.0, kFiner * text.size.x(), kFiner * text.size.y()),
                   align | Qt::AlignTop | Qt::TextWordWrap, QString::fromStdString(text.words));
  painter.restore();
}

QByteArray pdfOf(const PrintDrawing& sheet, const QString& title) {
  const ScreenlessApplication application;
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setTitle(title);
  writer.setCreator(QStringLiteral("Gyre"));
  writer.setResolution(kDotsPerInch);
  writer.setPageLayout(
      QPageLayout(QPageSize(QSizeF(sheet.size.x(), sheet.size.y()), QPageSize::Millimeter,
                            QString(), QPageSize::ExactMatch),
                  QPageLayout::Portrait, QMarginsF()));
  QPainter painter(&writer);
  painter.scale(kDotsPerInch / kMmPerInch, kDotsPerInch / kMmPerInch);
  paintPolygons(sheet, PrintPolygon::Ink::kBlack, painter);
  paintPolygons(sheet, PrintPolygon::Ink::kWhite, painter);
  for (const PrintLine& line : sheet.lines) {
    painter.setPen(penFor(line.kind));
    painter.drawLine(QPointF(line.from.x(), line.from.y()), QPointF(line.to.x(), line.to.y()));
  }
  for (const PrintText& text : sheet.texts) paintText(text, painter);
  painter.end();
  return bytes;
}

}  // namespace

Result<void> printTarget(const StandardTarget& target, const PageSize& page,
                         const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) {
    return Error{Error::Code::kIo, "The folder \"" + folder.string() + "\" cannot be made.",
                 "Name a folder that you may write to."};
  }
  const std::string& name = target.target.name;
  const QByteArray pdf = pdfOf(sheetOf(target, page), QString::fromStdString(target.title));
  const std::string_view bytes(pdf.constData(), static_cast<std::size_t>(pdf.size()));
  if (auto done = writeFileAtomically(folder / (name + ".pdf"), bytes); !done) return done;
  return writeTarget(folder / (name + ".target.json"), target.target);
}

}  // namespace gyre
