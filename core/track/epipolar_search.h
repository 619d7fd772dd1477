// Finds in the next view a feature whose depth is not yet known.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/frame.h"
#include "core/track/search_volume.h"

namespace gyre {

struct EpipolarMatch {
  Eigen::Vector2d pixel;  // to about a pixel; KLT makes it exact
  float correlation = 0.0F;
};

// Looks for the patch around a pixel along the curve on which the table's turning can have
// moved it: the picture of its ray inside the volume. A 10 degree step moves features by dozens of
// pixels, far beyond what KLT finds, yet along that curve only. Returns the best match, or nothing
// when the ray misses the volume or the patch holds no texture.
class EpipolarSearch {
 public:
  EpipolarSearch(const CameraModel& camera, const SearchVolume& volume)
      : camera_(camera), volume_(volume) {}

  std::optional<EpipolarMatch> find(const cv::Mat& from_grey, const Rigid3& from_cam_from_table,
                                    const Eigen::Vector2d& from_pixel, const cv::Mat& to_grey,
                                    const Rigid3& to_cam_from_table) const;

 private:
  CameraModel camera_;
  SearchVolume volume_;
};

}  // namespace gyre
