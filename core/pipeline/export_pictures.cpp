// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/export_pictures.h"

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
    if (isThere(folder / name)) continue;
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
  posed.camera = views->calibration.camera;
  const std::vector<Rigid3> poses = views->camFromTable();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    posed.pictures.push_back({std::move(views->angles[i].picture), poses[i], {}});
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
  const std::vector<fs::path> folders = request.pictures.empty()
                                            ? pictureFoldersOf(request.folder)
                                            : std::vector<fs::path>{request.pictures};
  std::vector<fs::path> files;
  for (const PosedPicture& picture : posed.pictures) {
    files.push_back(findPicture(folders, picture.name));
    if (files.back().empty()) {
      return Error{Error::Code::kNotFound,
                   "The picture \"" + picture.name + "\" that the result was made from is missing.",
                   "Name the folder of the pictures with --images."};
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(files.size()), "Copying pictures");
    const auto done = transferPicture(files[i], request.out / "images" / posed.pictures[i].name,
                                      request.transfer);
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
    cv::resize(silhouette.mask, mask, {posed.camera.width_px, posed.camera.height_px}, 0.0, 0.0,
               cv::INTER_NEAREST);
    const auto done = writePicture(request.out / "masks" / picture.mask, mask);
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
