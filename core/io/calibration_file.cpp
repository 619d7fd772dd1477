// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/calibration_file.h"

#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMaxBytes = 64U << 20U;  // room for residuals and covariances beside
constexpr double kMaxSide_px = 65536.0;
constexpr double kMaxFocal_px = 1e7;
constexpr double kMaxPrincipal_px = 1e6;
constexpr double kMaxDistortion = 1e4;
constexpr double kMaxDistance_mm = 1e6;

// Takes fields out of the file and keeps the first thing that is wrong with them.
class FieldReader {
 public:
  explicit FieldReader(std::string file) : file_(std::move(file)) {}

  const std::optional<Error>& error() const { return error_; }

  void fail(const std::string& problem) {
    if (error_) return;
    error_ = Error{Error::Code::kInvalidInput, "The calibration \"" + file_ + "\" " + problem + ".",
                   "Calibrate again, or give another calibration file."};
  }

  // The member, or null after a failure.
  const json& member(const json& object, const std::string& key) {
    static const json kNull;
    if (object.is_object() && object.contains(key)) return object.at(key);
    fail("lacks \"" + key + "\"");
    return kNull;
  }

  double number(const json& value, const std::string& name, double limit) {
    if (!value.is_number()) {
      fail("has something else than a number for \"" + name + "\"");
      return 0.0;
    }
    const auto found = value.get<double>();
    if (!std::isfinite(found) || std::abs(found) > limit) {
      fail("has an impossible value for \"" + name + "\"");
      return 0.0;
    }
    return found;
  }

  double numberAt(const json& object, const std::string& key, double limit) {
    return number(member(object, key), key, limit);
  }

  // True when the value is an array of so many.
  bool arrayOf(const json& value, std::size_t count, const std::string& name) {
    if (value.is_array() && value.size() == count) return true;
    fail("does not have " + std::to_string(count) + " entries in \"" + name + "\"");
    return false;
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

void readFormat(FieldReader& reader, const json& root) {
  if (!root.is_object() || root.value("format", json()) != "gyre-calibration") {
    reader.fail("is no calibration of Gyre: its \"format\" is not \"gyre-calibration\"");
    return;
  }
  if (root.value("version", json()) != 1) {
    reader.fail("is of a version that this program does not know");
  }
}

int readSide(FieldReader& reader, const json& value) {
  const double side = reader.number(value, "image_size", kMaxSide_px);
  if (side < 1.0 || side != std::floor(side)) {
    reader.fail("has an impossible \"image_size\"");
    return 0;
  }
  return static_cast<int>(side);
}

void readCamera(FieldReader& reader, const json& root, CameraModel& camera) {
  const json& size = reader.member(root, "image_size");
  if (!reader.arrayOf(size, 2, "image_size")) return;
  camera.width_px = readSide(reader, size[0]);
  camera.height_px = readSide(reader, size[1]);
  const json& values = reader.member(root, "camera");
  camera.fx = reader.numberAt(values, "fx", kMaxFocal_px);
  camera.fy = reader.numberAt(values, "fy", kMaxFocal_px);
  if (camera.fx <= 0.0 || camera.fy <= 0.0) {
    reader.fail("has a focal length that is not above zero");
  }
  camera.skew = reader.numberAt(values, "skew", kMaxFocal_px);
  camera.cx = reader.numberAt(values, "cx", kMaxPrincipal_px);
  camera.cy = reader.numberAt(values, "cy", kMaxPrincipal_px);
  const json& distortion = reader.member(values, "distortion");
  if (reader.member(distortion, "model") != "brown") {
    reader.fail("uses a distortion model that this program does not know");
  }
  for (const auto& [key, field] :
       {std::pair{"k1", &CameraModel::k1}, std::pair{"k2", &CameraModel::k2},
        std::pair{"p1", &CameraModel::p1}, std::pair{"p2", &CameraModel::p2},
        std::pair{"k3", &CameraModel::k3}}) {
    camera.*field = reader.numberAt(distortion, key, kMaxDistortion);
  }
}

std::optional<Rigid3> readPose(FieldReader& reader, const json& root) {
  const json& pose = reader.member(root, "cam_from_table");
  if (pose.is_null()) return std::nullopt;
  const json& rows = reader.member(pose, "rotation");
  const json& translation = reader.member(pose, "translation_mm");
  if (!reader.arrayOf(rows, 3, "rotation")) return std::nullopt;
  if (!reader.arrayOf(translation, 3, "translation_mm")) return std::nullopt;
  Rigid3 cam_from_table;
  for (int row = 0; row < 3; ++row) {
    const json& entries = rows[static_cast<std::size_t>(row)];
    if (!reader.arrayOf(entries, 3, "rotation")) return std::nullopt;
    for (int column = 0; column < 3; ++column) {
      cam_from_table.rotation(row, column) =
          reader.number(entries[static_cast<std::size_t>(column)], "rotation", 1.01);
    }
    cam_from_table.translation[row] = reader.number(translation[static_cast<std::size_t>(row)],
                                                    "translation_mm", kMaxDistance_mm);
  }
  if (!isRigid(cam_from_table)) reader.fail("has a \"rotation\" that is not a rotation");
  return cam_from_table;
}

std::string field(const char* key, double value) {
  return std::string(1, '"').append(key).append("\": ").append(jsonNumber(value));
}

std::string triple(const Eigen::Vector3d& values) {
  std::string text(1, '[');
  for (int i = 0; i < 3; ++i) text.append(i == 0 ? "" : ", ").append(jsonNumber(values[i]));
  return text.append("]");
}

}  // namespace

Result<Calibration> parseCalibration(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const json root = json::parse(text);
  FieldReader reader(file);
  Calibration calibration;
  readFormat(reader, root);
  if (!reader.error()) readCamera(reader, root, calibration.camera);
  if (!reader.error()) calibration.cam_from_table = readPose(reader, root);
  if (reader.error()) return *reader.error();
  return calibration;
}

Result<Calibration> readCalibration(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseCalibration(*text, file.string());
}

std::string calibrationText(const Calibration& calibration) {
  const CameraModel& camera = calibration.camera;
  std::string text = "{\n  \"format\": \"gyre-calibration\",\n  \"version\": 1,\n";
  text += "  \"image_size\": [" + std::to_string(camera.width_px) + ", " +
          std::to_string(camera.height_px) + "],\n";
  text += "  \"camera\": { " + field("fx", camera.fx) + ", " + field("fy", camera.fy) + ", " +
          field("skew", camera.skew) + ", " + field("cx", camera.cx) + ", " +
          field("cy", camera.cy) + ",\n";
  text += "    \"distortion\": { \"model\": \"brown\", " + field("k1", camera.k1) + ", " +
          field("k2", camera.k2) + ", " + field("p1", camera.p1) + ", " + field("p2", camera.p2) +
          ", " + field("k3", camera.k3) + " } },\n";
  if (!calibration.cam_from_table) return text + "  \"cam_from_table\": null\n}\n";
  const Rigid3& pose = *calibration.cam_from_table;
  text += "  \"cam_from_table\": {\n    \"rotation\": [" + triple(pose.rotation.row(0)) +
          ",\n                 " + triple(pose.rotation.row(1)) + ",\n                 " +
          triple(pose.rotation.row(2)) + "],\n";
  text += "    \"translation_mm\": " + triple(pose.translation) + " }\n}\n";
  return text;
}

Result<void> writeCalibration(const std::filesystem::path& file, const Calibration& calibration) {
  const std::string text = calibrationText(calibration);
  if (const auto readable = parseCalibration(text, file.string()); !readable) {
    return readable.error();
  }
  return writeFileAtomically(file, text);
}

}  // namespace gyre
