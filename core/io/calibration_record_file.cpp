// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/calibration_record_file.h"

#include <type_traits>

#include "core/io/atomic_file.h"
#include "core/io/calibration_file.h"
#include "core/io/json_text.h"
#include "core/io/report_fields.h"

namespace gyre {
namespace {

std::string quoted(const std::string& key) { return "\"" + key + "\": "; }

template <class Number>
std::string numberText(Number value) {
  if constexpr (std::is_integral_v<Number>) return std::to_string(value);
  return jsonNumber(static_cast<double>(value));
}

template <class Items, class ToText>
std::string listText(const Items& items, const std::string& between, const ToText& textOf) {
  std::string text = "[";
  bool first = true;
  for (const auto& item : items) {
    text += (first ? "" : between) + textOf(item);
    first = false;
  }
  return text + "]";
}

std::string vectorText(const Eigen::VectorXd& values) {
  return listText(values, ", ", [](double value) { return jsonNumber(value); });
}

std::string rowsText(const Eigen::MatrixXd& matrix) {
  std::string text = "[";
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    text += (row == 0 ? "" : ",\n      ") + vectorText(matrix.row(row));
  }
  return text + "]";
}

std::string poseText(const Rigid3& pose) {
  return "{ " + quoted("rotation") + rowsText(pose.rotation) + ",\n    " +
         quoted("translation_mm") + vectorText(pose.translation) + " }";
}

std::string turntableText(const CalibratedTurntable& turntable) {
  std::string measured;
  if (turntable.backlash_rad > 0.0) {
    measured += ", " + quoted("backlash_rad") + jsonNumber(turntable.backlash_rad);
  }
  if (turntable.settle_s > 0.0) {
    measured += ", " + quoted("settle_s") + jsonNumber(turntable.settle_s);
  }
  return "{ " + quoted("device_id") + jsonString(turntable.device_id) + ", " + quoted("axis") +
         jsonString(turntable.axis) + ", " + quoted("units_per_turn") +
         jsonNumber(turntable.units_per_turn) + ", " + quoted("direction") +
         std::to_string(turntable.direction) + measured + " }";
}

std::string cameraText(const CalibratedCamera& camera) {
  std::string settings;
  for (const auto& [name, value] : camera.settings) {
    settings += (settings.empty() ? "" : ", ") + jsonString(name) + ": " + jsonNumber(value);
  }
  return "{ " + quoted("device_id") + jsonString(camera.device_id) + ", " + quoted("mode") +
         jsonString(camera.mode) + ", " + quoted("settings") + "{ " + settings + " } }";
}

const char* verdictWord(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::kGood:
      return "good";
    case CalibrationVerdict::kAcceptable:
      return "acceptable";
    case CalibrationVerdict::kRedo:
      break;
  }
  return "redo";
}

std::string faceText(const FaceReport& face) {
  std::string text;
  visitFaceFigures(face, [&](const char* name, auto value) {
    text += (text.empty() ? "{ " : ", ") + quoted(name) + numberText(value);
  });
  return text + " }";
}

std::string reportText(const CalibrationReport& report) {
  std::string text = "{\n    " + quoted("verdict") + jsonString(verdictWord(report.verdict)) +
                     ",\n    " + quoted("sentence") + jsonString(report.sentence) + ",\n    " +
                     quoted("size_verified") + (report.size_verified ? "true" : "false");
  visitReportFigures(report, [&](const char* name, auto value) {
    text += ",\n    " + quoted(name) + numberText(value);
  });
  text += ",\n    " + quoted("remarks") +
          listText(report.remarks, ",\n      ", [](const std::string& s) { return jsonString(s); });
  text += ",\n    " + quoted("angles_rad") +
          listText(report.angles_rad, ", ", [](double angle) { return jsonNumber(angle); });
  text += ",\n    " + quoted("faces") + listText(report.faces, ",\n      ", faceText);
  return text + " }";
}

// [view, point, x, y, dx, dy, used] a sighting.
std::string residualsText(const std::vector<CalibrationResidual>& residuals) {
  std::vector<CalibrationResidual> finite;
  for (const CalibrationResidual& residual : residuals) {
    if (residual.residual_px.allFinite() && residual.pixel.allFinite()) finite.push_back(residual);
  }
  return listText(finite, ",\n    ", [](const CalibrationResidual& r) {
    return "[" + std::to_string(r.view) + ", " + std::to_string(r.point) + ", " +
           jsonNumber(r.pixel.x()) + ", " + jsonNumber(r.pixel.y()) + ", " +
           jsonNumber(r.residual_px.x()) + ", " + jsonNumber(r.residual_px.y()) + ", " +
           (r.used ? "true" : "false") + "]";
  });
}

}  // namespace

std::string calibrationRecordText(const CalibrationRecord& record) {
  std::string text = calibrationText(record.calibration);
  text.erase(text.rfind("\n}"));  // what follows goes inside
  const auto add = [&](const char* key, const std::string& value) {
    text += ",\n  " + quoted(key) + value;
  };
  if (!record.date.empty()) add("date", jsonString(record.date));
  if (!record.target.empty()) add("target", jsonString(record.target));
  if (record.turntable) add("turntable", turntableText(*record.turntable));
  if (record.camera) add("capture", cameraText(*record.camera));
  if (record.table_from_target) add("table_from_target", poseText(*record.table_from_target));
  if (!record.points_in_target.empty()) {
    add("points_in_target_mm", listText(record.points_in_target, ", ",
                                        [](const Eigen::Vector3d& p) { return vectorText(p); }));
  }
  if (record.report) {
    add("report", reportText(*record.report));
    add("residuals", residualsText(record.report->residuals));
  }
  if (record.covariance) {
    add("covariance", "{\n    " + quoted("names") +
                          listText(record.covariance->names, ", ",
                                   [](const std::string& name) { return jsonString(name); }) +
                          ",\n    " + quoted("matrix") + rowsText(record.covariance->matrix) +
                          " }");
  }
  return text + "\n}\n";
}

Result<void> writeCalibrationRecord(const std::filesystem::path& file,
                                    const CalibrationRecord& record) {
  const std::string text = calibrationRecordText(record);
  if (const auto readable = parseCalibrationRecord(text, file.string()); !readable) {
    return readable.error();
  }
  return writeFileAtomically(file, text);
}

}  // namespace gyre
