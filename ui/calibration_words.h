// What people are told of a calibration they have: how good it is, and how old.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDateTime>
#include <QString>

#include "core/scan/calibration_record.h"

namespace gyre {

// A sign and a word: the sign tells it without the colour.
QString verdictText(CalibrationVerdict verdict);

// "△ Acceptable: detail ± 0.004 mm, size ± 0.20 mm".
QString qualityText(const CalibrationReport& report);

// "measured today", "measured 3 days ago"; empty when the record has no date, or one to come.
QString ageText(const CalibrationRecord& record, const QDateTime& now);

// Both on one line, as far as they are known.
QString calibrationText(const CalibrationRecord& record, const QDateTime& now);

}  // namespace gyre
