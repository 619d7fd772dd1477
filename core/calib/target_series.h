// Finds a target in picture after picture of a turning table, its points named alike in all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/find_target.h"

namespace gyre {

// Fed with the pictures in the order in which the table turned. A target that looks the same from
// several sides is named any way in the first picture, and in each later one so that it has turned
// the least since the last find; once it has turned, axis and rate of the turn predict the next
// pose from the commanded angle. Both take no direction, scale or place of the axis for granted,
// but the first steps must stay well below half of the angle at which the target looks the same
// again: 45 degrees for a cube. Coded targets need none of this and get none of it.
class TargetSeries {
 public:
  explicit TargetSeries(Target target, FindTargetOptions options = {});

  // Like findTarget(); view gets the name and the angle. labellings above one in any picture but
  // the first says that the step was too wide to tell, or the angle unknown.
  Result<FoundTarget> add(const cv::Mat& image, const std::string& name,
                          std::optional<double> table_angle_rad, const Task& task = {});

 private:
  struct Solved {
    Rigid3 cam_from_target;
    std::optional<double> table_angle_rad;
  };
  std::optional<Rigid3> expected(std::optional<double> table_angle_rad) const;
  void learn(const Solved& now);

  Target target_;
  FindTargetOptions options_;
  std::optional<Solved> last_;
  // How the target turns in its own frame: unit axis times radians turned a radian commanded.
  std::optional<Eigen::Vector3d> turn_in_target_;
};

// A picture of a series, opened when its turn comes, so that only one is in memory.
struct SeriesPicture {
  std::string name;
  std::optional<double> table_angle_rad;
  std::function<Result<cv::Mat>()> open;
};

// One result a picture: a find, or why there is none. A failed one does not end the series.
// Fails as a whole only when the task is stopped.
Result<std::vector<Result<FoundTarget>>> findTargets(const std::vector<SeriesPicture>& pictures,
                                                     const Target& target,
                                                     const FindTargetOptions& options = {},
                                                     const Task& task = {});

}  // namespace gyre
