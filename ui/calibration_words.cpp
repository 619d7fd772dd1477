// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_words.h"

#include <QCoreApplication>
#include <QStringList>

namespace gyre {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("Calibration", text); }

}  // namespace

QString verdictText(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::kGood:
      return tr("✓ Good");
    case CalibrationVerdict::kAcceptable:
      return tr("△ Acceptable");
    case CalibrationVerdict::kRedo:
      return tr("✗ Do it again");
  }
  return {};
}

QString qualityText(const CalibrationReport& report) {
  return tr("%1: detail ± %2 mm, size ± %3 mm%4")
      .arg(verdictText(report.verdict))
      .arg(report.local_detail_mm, 0, 'f', 3)
      .arg(report.overall_size_mm, 0, 'f', 2)
      .arg(report.size_verified ? QString() : tr(" (size not verified)"));
}

QString ageText(const CalibrationRecord& record, const QDateTime& now) {
  const auto measured = QDateTime::fromString(QString::fromStdString(record.date), Qt::ISODate);
  if (!measured.isValid()) return {};
  const qint64 days = measured.toLocalTime().date().daysTo(now.toLocalTime().date());
  if (days < 0) return {};
  if (days == 0) return tr("measured today");
  if (days == 1) return tr("measured yesterday");
  return tr("measured %1 days ago").arg(days);
}

QString calibrationText(const CalibrationRecord& record, const QDateTime& now) {
  QStringList parts;
  // A hand-held set and known corners have a fit and no verdict.
  if (record.report && !record.report->sentence.empty()) parts << qualityText(*record.report);
  const QString age = ageText(record, now);
  if (!age.isEmpty()) parts << age;
  return parts.join(" · ");
}

}  // namespace gyre
