// Table angles of pictures that were taken with unknown steps.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/reconstruct.h"
#include "core/recover/turn_steps.h"

namespace gyre {

// Finds the angles of pictures in the order in which they were taken (turnSteps), and puts the
// views in the order of their angles, the first picture at 0. Changes nothing when it fails: when a
// picture cannot be read, the pictures do not tell, or the task is stopped.
Result<TurnSteps> findAngles(PreparedPictures& prepared, const Task& task);

}  // namespace gyre
