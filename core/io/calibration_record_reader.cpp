// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "core/io/calibration_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/file_bytes.h"
#include "core/io/report_fields.h"

namespace gyre {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMaxBytes = 64U << 20U;
constexpr double kMostCounted = 1e15;  // what a double still counts one by one

// The member, or null.
const json& memberOf(const json& object, const char* key) {
  static const json kNull;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : kNull;
}

std::string textOf(const json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

// Leaves the number as it is when the value is none, or none of its kind.
template <class Number>
void read(const json& value, Number& number) {
  if (!value.is_number()) return;
  const double found = value.get<double>();
  if (!std::isfinite(found)) return;
  if constexpr (std::is_integral_v<Number>) {
    const bool counts = found == std::floor(found) && std::abs(found) <= kMostCounted &&
                        (std::is_signed_v<Number> ? std::abs(found) < 2147483647.0 : found >= 0.0);
    if (!counts) return;
  }
  number = static_cast<Number>(found);
}

// All numbers of a list, or nothing when one is none.
std::optional<std::vector<double>> numbersOf(const json& list) {
  if (!list.is_array()) return std::nullopt;
  std::vector<double> numbers;
  for (const json& value : list) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return std::nullopt;
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::optional<Eigen::MatrixXd> matrixOf(const json& rows, std::size_t height, std::size_t width) {
  if (!rows.is_array() || rows.size() != height) return std::nullopt;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(height), static_cast<Eigen::Index>(width));
  for (std::size_t row = 0; row < height; ++row) {
    const auto numbers = numbersOf(rows[row]);
    if (!numbers || numbers->size() != width) return std::nullopt;
    for (std::size_t column = 0; column < width; ++column) {
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          (*numbers)[column];
    }
  }
  return matrix;
}

std::optional<Rigid3> poseOf(const json& value) {
  const auto rotation = matrixOf(memberOf(value, "rotation"), 3, 3);
  const auto translation = numbersOf(memberOf(value, "translation_mm"));
  if (!rotation || !translation || translation->size() != 3) return std::nullopt;
  const Rigid3 pose{*rotation, Eigen::Map<const Eigen::Vector3d>(translation->data())};
  return isRigid(pose) ? std::optional(pose) : std::nullopt;
}

std::optional<CalibratedTurntable> turntableOf(const json& value) {
  if (!value.is_object()) return std::nullopt;
  CalibratedTurntable turntable;
  turntable.device_id = textOf(memberOf(value, "device_id"));
  turntable.axis = textOf(memberOf(value, "axis"));
  read(memberOf(value, "units_per_turn"), turntable.units_per_turn);
  read(memberOf(value, "direction"), turntable.direction);
  read(memberOf(value, "backlash_rad"), turntable.backlash_rad);
  read(memberOf(value, "settle_s"), turntable.settle_s);
  return turntable;
}

std::optional<CalibratedCamera> cameraOf(const json& value) {
  if (!value.is_object()) return std::nullopt;
  CalibratedCamera camera;
  camera.device_id = textOf(memberOf(value, "device_id"));
  camera.mode = textOf(memberOf(value, "mode"));
  const json& settings = memberOf(value, "settings");
  if (!settings.is_object()) return camera;
  for (const auto& [name, setting] : settings.items()) {
    if (setting.is_number()) camera.settings[name] = setting.get<double>();
  }
  return camera;
}

std::optional<NamedCovariance> covarianceOf(const json& value) {
  const json& names = memberOf(value, "names");
  if (!names.is_array()) return std::nullopt;
  NamedCovariance covariance;
  for (const json& name : names) covariance.names.push_back(textOf(name));
  auto matrix = matrixOf(memberOf(value, "matrix"), names.size(), names.size());
  if (!matrix) return std::nullopt;
  covariance.matrix = std::move(*matrix);
  return covariance;
}

std::vector<Eigen::Vector3d> pointsIn(const json& list) {
  if (!list.is_array()) return {};
  std::vector<Eigen::Vector3d> points;
  for (const json& value : list) {
    const auto numbers = numbersOf(value);
    if (!numbers || numbers->size() != 3) return {};
    points.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  return points;
}

CalibrationVerdict verdictOf(const std::string& word) {
  if (word == "good") return CalibrationVerdict::kGood;
  return word == "acceptable" ? CalibrationVerdict::kAcceptable : CalibrationVerdict::kRedo;
}

std::vector<CalibrationResidual> residualsOf(const json& list) {
  std::vector<CalibrationResidual> residuals;
  if (!list.is_array()) return residuals;
  for (const json& value : list) {
    if (!value.is_array() || value.size() != 7 || !value[6].is_boolean()) return {};
    CalibrationResidual residual;
    read(value[0], residual.view);
    read(value[1], residual.point);
    read(value[2], residual.pixel.x());
    read(value[3], residual.pixel.y());
    read(value[4], residual.residual_px.x());
    read(value[5], residual.residual_px.y());
    residual.used = value[6].get<bool>();
    residuals.push_back(residual);
  }
  return residuals;
}

std::optional<CalibrationReport> reportOf(const json& root) {
  const json& value = memberOf(root, "report");
  if (!value.is_object()) return std::nullopt;
  CalibrationReport report;
  report.verdict = verdictOf(textOf(memberOf(value, "verdict")));
  report.sentence = textOf(memberOf(value, "sentence"));
  report.size_verified = memberOf(value, "size_verified") == true;
  visitReportFigures(report,
                     [&](const char* name, auto& number) { read(memberOf(value, name), number); });
  const json& remarks = memberOf(value, "remarks");
  if (remarks.is_array()) {
    for (const json& remark : remarks) report.remarks.push_back(textOf(remark));
  }
  report.angles_rad = numbersOf(memberOf(value, "angles_rad")).value_or(std::vector<double>{});
  const json& faces = memberOf(value, "faces");
  if (faces.is_array()) {
    for (const json& face : faces) {
      report.faces.emplace_back();
      visitFaceFigures(report.faces.back(),
                       [&](const char* name, auto& number) { read(memberOf(face, name), number); });
    }
  }
  report.residuals = residualsOf(memberOf(root, "residuals"));
  return report;
}

}  // namespace

Result<CalibrationRecord> parseCalibrationRecord(std::string_view text, const std::string& file) {
  auto calibration = parseCalibration(text, file);
  if (!calibration) return calibration.error();
  const json root = json::parse(text);
  CalibrationRecord record;
  record.calibration = *calibration;
  record.date = textOf(memberOf(root, "date"));
  record.target = textOf(memberOf(root, "target"));
  record.report = reportOf(root);
  record.covariance = covarianceOf(memberOf(root, "covariance"));
  record.table_from_target = poseOf(memberOf(root, "table_from_target"));
  record.points_in_target = pointsIn(memberOf(root, "points_in_target_mm"));
  record.turntable = turntableOf(memberOf(root, "turntable"));
  record.camera = cameraOf(memberOf(root, "capture"));
  return record;
}

Result<CalibrationRecord> readCalibrationRecord(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseCalibrationRecord(*text, file.string());
}

}  // namespace gyre
