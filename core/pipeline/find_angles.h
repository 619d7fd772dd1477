// Table angles of pictures that were taken with unknown steps.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/pipeline/match_pictures.h"
#include "core/pipeline/reconstruct.h"
#include "core/recover/turn_steps.h"

namespace gyre {

// Finds the angles of pictures in the order in which they were taken (turnSteps) from what they
// share (matchPictures), and puts the views in the order of their angles, the first picture at 0.
// Changes nothing when it fails: when the pictures do not tell.
Result<TurnSteps> findAngles(PreparedPictures& prepared, const MatchedPictures& matched);

}  // namespace gyre
