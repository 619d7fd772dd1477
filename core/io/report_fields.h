// The figures of a calibration's report, by the names they have in the file: one list for reading
// and for writing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/calibration_report.h"

namespace gyre {

// visit(name, number) for each; Report is CalibrationReport, const or not.
template <class Report, class Visit>
void visitReportFigures(Report& report, const Visit& visit) {
  visit("object_size_mm", report.object_size_mm);
  visit("local_detail_mm", report.local_detail_mm);
  visit("overall_size_mm", report.overall_size_mm);
  visit("check_mm", report.check_mm);
  visit("rms_px", report.rms_px);
  visit("median_px", report.median_px);
  visit("worst_px", report.worst_px);
  visit("views", report.views);
  visit("sightings", report.sightings);
  visit("outliers", report.outliers);
  visit("focal_sigma_px", report.focal_sigma_px);
  visit("principal_sigma_px", report.principal_sigma_px);
  visit("axis_tilt_sigma_rad", report.axis_tilt_sigma_rad);
  visit("axis_offset_sigma_mm", report.axis_offset_sigma_mm);
  visit("direction", report.direction);
  visit("step_scale", report.step_scale);
  visit("once_per_turn_rad", report.once_per_turn.amplitude_rad);
  visit("once_per_turn_phase_rad", report.once_per_turn.phase_rad);
  visit("twice_per_turn_rad", report.twice_per_turn.amplitude_rad);
  visit("twice_per_turn_phase_rad", report.twice_per_turn.phase_rad);
}

template <class Face, class Visit>
void visitFaceFigures(Face& face, const Visit& visit) {
  visit("bow_mm", face.bow_mm);
  visit("tilt_rad", face.tilt_rad);
  visit("shift_mm", face.shift_mm);
  visit("points", face.points);
}

}  // namespace gyre
