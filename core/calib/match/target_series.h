// Finds a target in the pictures of a turning table, its points named alike in all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/match/find_target.h"

namespace gyre {

// A picture of a series, opened when its turn comes, so that only one is in memory; a second time
// when the target looks the same from several sides.
struct SeriesPicture {
  std::string name;
  std::optional<double> table_angle_rad;  // as commanded; none when nobody knows
  std::function<Result<cv::Mat>()> open;
};

// One result a picture: a find, or why there is none. Views have the pictures' names and angles.
//
// A target that looks the same from several sides is named so that it turns about its own z axis,
// for it stands on the table, and from picture to picture as little as possible until two pictures
// have told how far it turns for a commanded angle, whatever direction and scale the motor has.
// The first steps must stay well below half of the angle at which the target looks the same again:
// 45 degrees for a cube. A labellings above one in a result then says only that this picture alone
// does not tell. Coded and marked targets need none of this.
//
// Fails as a whole only when the task is stopped.
Result<std::vector<Result<FoundTarget>>> findTargets(const std::vector<SeriesPicture>& pictures,
                                                     const Target& target,
                                                     const FindTargetOptions& options = {},
                                                     const Task& task = {});

}  // namespace gyre
