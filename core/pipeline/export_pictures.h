// Hands a result on to other programs: pictures with cameras, masks and points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

enum class ExportKind : std::uint8_t {
  kColmap,      // images/, masks/, sparse/0/{cameras,images,points3D}.txt
  kTransforms,  // images/, masks/, transforms.json
};

enum class PictureTransfer : std::uint8_t {
  kCopy,
  kLink,  // symbolic links: no disk space, but what changes them changes the scan
};

struct ExportRequest {
  std::filesystem::path folder;    // of the result: points.ply, calibration.json, angles_solved.csv
  std::filesystem::path pictures;  // where its pictures lie; empty: where the result says
  std::filesystem::path out;       // made where it is missing
  ExportKind kind = ExportKind::kColmap;
  PictureTransfer transfer = PictureTransfer::kCopy;
};

struct ExportSummary {
  std::size_t pictures = 0;
  std::size_t masks = 0;
  std::size_t points = 0;
  std::size_t sightings = 0;  // 0 when the result keeps none: made by an older version
};

// Masks are the object's outlines, where the result has silhouettes.bin; NAME.png.png for a picture
// NAME.png, as COLMAP looks for them. Files that are there are replaced. Fails in words when
// anything is missing, and when stopped; the result itself is never changed.
Result<ExportSummary> exportPictures(const ExportRequest& request, const Task& task);

}  // namespace gyre
