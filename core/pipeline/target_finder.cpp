// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/target_finder.h"

#include <memory>
#include <utility>

#include "core/calib/match/find_target.h"
#include "core/calib/match/target_series.h"

namespace gyre {

SoughtTarget soughtTarget(const Target& target, const FindTargetOptions& start) {
  SoughtTarget sought;
  sought.target = target;
  const auto options = std::make_shared<FindTargetOptions>(start);
  sought.find = [target, options](const cv::Mat& image_bgr) -> Result<TargetView> {
    auto found = findTarget(image_bgr, target, *options);
    if (!found) return found.error();
    if (found->cam_from_target) {
      options->expected_cam_from_target = found->cam_from_target;
      options->camera = found->camera;
    }
    return std::move(found->view);
  };
  sought.find_all = [target, start](const std::vector<SeriesPicture>& pictures,
                                    const Task& task) -> Result<std::vector<Result<TargetView>>> {
    auto found = findTargets(pictures, target, start, task);
    if (!found) return found.error();
    std::vector<Result<TargetView>> views;
    views.reserve(found->size());
    for (Result<FoundTarget>& one : *found) {
      if (one) {
        views.emplace_back(std::move(one->view));
      } else {
        views.emplace_back(one.error());
      }
    }
    return views;
  };
  return sought;
}

}  // namespace gyre
