// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/report_page.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/io/atomic_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/file_bytes.h"
#include "core/io/measurements_file.h"
#include "core/io/model_file.h"
#include "core/io/model_label.h"
#include "core/io/picture_file.h"
#include "core/io/report_reader.h"
#include "core/mesh/mesh_health.h"
#include "core/pipeline/model_picture.h"
#include "core/pipeline/result_pictures.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr int kPhotoWidth_px = 480;
constexpr int kPhotoQuality = 85;
constexpr int kSide_px = 320;
constexpr int kFiner = 2;  // painted so much larger, for smooth edges
constexpr double kElevation_rad = radFromDeg(15.0);
constexpr std::array<std::pair<const char*, double>, 4> kSides = {{{"From the front", 0.0},
                                                                   {"From the right", 90.0},
                                                                   {"From behind", 180.0},
                                                                   {"From the left", 270.0}}};

cv::Mat resized(const cv::Mat& picture, int width_px) {
  const int height_px = std::max(1, width_px * picture.rows / picture.cols);
  cv::Mat small;
  cv::resize(picture, small, {width_px, height_px}, 0.0, 0.0, cv::INTER_AREA);
  return small;
}

void addPhoto(const fs::path& folder, ReportFacts& facts) {
  const fs::path file = firstPictureOf(folder);
  if (file.empty()) return;
  const auto photo = readPicture(file);
  if (!photo) {
    facts.doubts.push_back(photo.error().what);
    return;
  }
  auto bytes = jpegBytes(resized(photo->image_bgr, kPhotoWidth_px), kPhotoQuality);
  if (bytes) facts.pictures.push_back({"Picture " + photo->name, "image/jpeg", std::move(*bytes)});
}

void addSides(const Model& model, ReportFacts& facts) {
  std::vector<PosedCamera> views;
  views.reserve(kSides.size());
  for (const auto& [caption, azimuth_deg] : kSides) {
    views.push_back(
        viewOf(facts.bounds, radFromDeg(azimuth_deg), kElevation_rad, kFiner * kSide_px));
  }
  std::vector<cv::Mat> sides;
  if (const auto* mesh = std::get_if<Mesh>(&model)) {
    sides = picturesOfSurface(*mesh, views, SurfacePaint::kColours);
  } else {
    sides.reserve(views.size());
    for (const PosedCamera& view : views) {
      sides.push_back(
          pictureOfPoints(std::get<PointCloud>(model), view.intrinsics, view.cam_from_table));
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    auto bytes = pngBytes(resized(sides[i], kSide_px));
    if (bytes) facts.pictures.push_back({kSides[i].first, "image/png", std::move(*bytes)});
  }
}

void addModel(const fs::path& folder, ReportFacts& facts) {
  const fs::path mesh_file = folder / "mesh.ply";
  const fs::path file = isThere(mesh_file) ? mesh_file : folder / "points.ply";
  if (!isThere(file)) return;
  const auto model = readMeshOrCloud(file);
  if (!model) {
    facts.doubts.push_back(model.error().what);
    return;
  }
  if (const auto* mesh = std::get_if<Mesh>(&*model)) {
    facts.health = meshHealth(*mesh);
    facts.bounds = boundsOf(*mesh);
  } else {
    facts.bounds = boundsOf(std::get<PointCloud>(*model));
  }
  if (!facts.bounds.empty()) addSides(*model, facts);
}

}  // namespace

Result<ReportFacts> reportFactsOf(const fs::path& folder) {
  auto report = readReport(folder / "report.json");
  if (!report) return report.error();
  ReportFacts facts;
  facts.report = std::move(*report);
  const ModelLabel label = labelOfScan(folder);  // which may have been changed since
  if (!label.title.empty()) facts.report.title = label.title;
  if (!label.inventory_number.empty()) facts.report.inventory_number = label.inventory_number;
  if (!label.rights.empty()) facts.report.rights = label.rights;
  if (const fs::path file = folder / "calibration.json"; isThere(file)) {
    auto record = readCalibrationRecord(file);
    if (record) {
      facts.calibration = std::move(*record);
    } else {
      facts.doubts.push_back(record.error().what);
    }
  }
  if (const fs::path file = folder / "measurements.json"; isThere(file)) {
    auto measurements = readMeasurements(file);
    if (measurements) {
      facts.measurements = std::move(*measurements);
    } else {
      facts.doubts.push_back(measurements.error().what);
    }
  }
  addPhoto(folder, facts);
  addModel(folder, facts);
  return facts;
}

Result<void> writeReportPage(const fs::path& folder) {
  const auto facts = reportFactsOf(folder);
  if (!facts) return facts.error();
  return writeFileAtomically(folder / "report.html", reportHtml(*facts));
}

Result<void> refreshReportPage(const fs::path& folder) {
  if (!isThere(folder / "report.json")) return {};
  return writeReportPage(folder);
}

}  // namespace gyre
