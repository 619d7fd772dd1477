// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/surface_spots.h"

#include <algorithm>
#include <string>

#include <opencv2/imgproc.hpp>

#include "core/io/picture_file.h"
#include "core/pipeline/merge/level_picture.h"
#include "core/pipeline/result_pictures.h"
#include "core/track/view_matches.h"

namespace gyre {
namespace {

// Steps of 15 degrees: what is a spot in one picture is the same spot in the next.
constexpr std::size_t kPicturesAsked = 24;

Result<cv::Mat> greyPicture(const PictureFinder& pictures, const ResultView& view) {
  const auto file = pictures.find(view.picture);
  if (file.empty()) {
    return Error{Error::Code::kNotFound,
                 "The picture \"" + view.picture + "\" of a pass is missing.",
                 "Passes are told to be of one object by their pictures: put them back where they "
                 "were, into the scan's frames folder."};
  }
  auto frame = readPicture(file);
  if (!frame) return frame.error();
  const CameraModel& camera = view.camera.intrinsics;
  if (frame->image_bgr.cols != camera.width_px || frame->image_bgr.rows != camera.height_px) {
    return Error{Error::Code::kInvalidInput,
                 "The picture \"" + file.string() +
                     "\" is not of the size that its calibration "
                     "is for.",
                 "Check that the pictures beside the points are those of the scan."};
  }
  cv::Mat grey;
  cv::cvtColor(frame->image_bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

Result<SurfaceSpots> findSurfaceSpots(const PassInput& pass, const Task& task) {
  const PictureFinder pictures(pass.folder);
  const std::size_t asked = std::min(kPicturesAsked, pass.views.size());
  SurfaceSpots spots;
  for (std::size_t i = 0; i < asked; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(asked),
                "Looking for spots to tell again");
    const ResultView& view = pass.views[i * pass.views.size() / asked];
    const auto grey = greyPicture(pictures, view);
    if (!grey) return grey.error();
    const LevelPicture level(pass.mesh, view.camera, *grey);
    if (level.grey().empty()) continue;
    const ViewSpots found = findSpots(level.grey(), level.mask());
    for (std::size_t k = 0; k < found.pixels.size(); ++k) {
      const auto at = level.at(found.pixels[k]);
      if (!at) continue;
      spots.places.push_back(at->first);
      spots.normals.push_back(at->second);
      spots.descriptors.push_back(found.descriptors.row(static_cast<int>(k)));
    }
  }
  return spots;
}

}  // namespace gyre
