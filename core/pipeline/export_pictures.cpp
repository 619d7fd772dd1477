// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/export_pictures.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/model_file.h"
#include "core/io/picture_file.h"
#include "core/io/posed_pictures.h"
#include "core/io/result_folder.h"
#include "core/io/silhouettes_file.h"
#include "core/pipeline/result_pictures.h"
#include "core/pipeline/result_views.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

Result<PosedPictures> readPosed(const fs::path& folder) {
  for (const char* name : {"points.ply", "calibration.json", "angles_solved.csv"}) {
    const bool merged = name == std::string("angles_solved.csv") && hasResultViews(folder);
    if (merged || isThere(folder / name)) continue;
    return Error{Error::Code::kNotFound,
                 "There is no " + std::string(name) + " in \"" + folder.string() + "\".",
                 "Name the folder of a finished scan or reconstruction; `gyre resume` finishes a "
                 "scan."};
  }
  auto views = readResultViews(folder);
  if (!views) return views.error();
  auto cloud = readPointCloud(folder / "points.ply");
  if (!cloud) return cloud.error();
  PosedPictures posed;
  for (ResultView& view : *views) {
    const auto known =
        std::find(posed.cameras.begin(), posed.cameras.end(), view.camera.intrinsics);
    const auto camera = static_cast<std::size_t>(known - posed.cameras.begin());
    if (known == posed.cameras.end()) posed.cameras.push_back(view.camera.intrinsics);
    posed.pictures.push_back({std::move(view.picture), view.camera.cam_from_table, {}, camera});
  }
  posed.cloud = std::move(*cloud);
  if (const fs::path file = folder / "sightings.bin"; isThere(file)) {
    auto sightings = readSightings(file, posed.cloud.points.size());
    if (!sightings) return sightings.error();
    posed.sightings = std::move(*sightings);
  }
  return posed;
}

Result<void> transferPicture(const fs::path& from, const fs::path& to, PictureTransfer transfer) {
  std::error_code problem;
  if (fs::equivalent(from, to, problem) && !fs::is_symlink(to)) return {};  // exported onto itself
  fs::remove(to, problem);
  if (!problem) {
    if (transfer == PictureTransfer::kLink) {
      fs::create_symlink(fs::absolute(from), to, problem);
    } else {
      fs::copy_file(from, to, problem);
    }
  }
  if (problem) return fileError(problem.value(), "write", to);
  return {};
}

Result<void> transferPictures(const ExportRequest& request, const PosedPictures& posed,
                              const Task& task) {
  const PictureFinder finder(request.folder, request.pictures);
  std::vector<fs::path> files;
  for (const PosedPicture& picture : posed.pictures) {
    files.push_back(finder.find(picture.name));
    if (files.back().empty()) {
      return Error{Error::Code::kNotFound,
                   "The picture \"" + picture.name + "\" that the result was made from is missing.",
                   "Name the folder of the pictures with --images."};
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(files.size()), "Copying pictures");
    const fs::path to = request.out / "images" / posed.pictures[i].name;
    if (const auto made = makeResultFolder(to.parent_path()); !made) return made;
    const auto done = transferPicture(files[i], to, request.transfer);
    if (!done) return done;
  }
  return {};
}

// Names each mask it writes in the picture it belongs to.
Result<std::size_t> writeMasks(const ExportRequest& request, PosedPictures& posed,
                               const Task& task) {
  const fs::path file = request.folder / "silhouettes.bin";
  if (!isThere(file)) return std::size_t{0};
  const auto silhouettes = readSilhouettes(file);
  if (!silhouettes) return silhouettes.error();
  if (silhouettes->empty()) return std::size_t{0};
  if (auto made = makeResultFolder(request.out / "masks"); !made) return made.error();
  std::size_t written = 0;
  for (const Silhouette& silhouette : *silhouettes) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(written) / static_cast<double>(silhouettes->size()),
                "Writing masks");
    if (silhouette.view >= posed.pictures.size()) continue;
    PosedPicture& picture = posed.pictures[silhouette.view];
    picture.mask = picture.name + ".png";
    cv::Mat mask;
    const CameraModel& camera = posed.cameras[picture.camera];
    cv::resize(silhouette.mask, mask, {camera.width_px, camera.height_px}, 0.0, 0.0,
               cv::INTER_NEAREST);
    const fs::path to = request.out / "masks" / picture.mask;
    if (auto made = makeResultFolder(to.parent_path()); !made) return made.error();
    const auto done = writePicture(to, mask);
    if (!done) return done.error();
    ++written;
  }
  return written;
}

Result<void> writeModel(const ExportRequest& request, const PosedPictures& posed) {
  if (request.kind == ExportKind::kColmap) {
    const fs::path folder = request.out / "sparse" / "0";
    if (auto made = makeResultFolder(folder); !made) return made;
    return writeColmapModel(folder, posed);
  }
  const auto text = transformsText(posed);
  if (!text) return text.error();
  return writeFileAtomically(request.out / "transforms.json", *text);
}

}  // namespace

Result<ExportSummary> exportPictures(const ExportRequest& request, const Task& task) {
  auto posed = readPosed(request.folder);
  if (!posed) return posed.error();
  if (auto made = makeResultFolder(request.out / "images"); !made) return made.error();
  if (auto done = transferPictures(request, *posed, task.part(0.0, 0.6)); !done) {
    return done.error();
  }
  const auto masks = writeMasks(request, *posed, task.part(0.6, 0.9));
  if (!masks) return masks.error();
  task.report(0.9, "Writing cameras and points");
  if (auto done = writeModel(request, *posed); !done) return done.error();
  ExportSummary summary;
  summary.pictures = posed->pictures.size();
  summary.masks = *masks;
  summary.points = posed->cloud.points.size();
  for (const auto& seen : posed->sightings) summary.sightings += seen.size();
  return summary;
}

}  // namespace gyre
