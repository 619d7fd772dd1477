// Whether a picture is sharp and well exposed, measured on what it shows.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/calib/match/target_picture.h"

namespace gyre {

struct PictureQuality {
  double white_share = 0.0;       // of the pixels that are at the top of the scale
  double brightest = 0.0;         // grey level that 1 % of the pixels exceed
  double contrast = 0.0;          // of its strong edges, grey levels; 0 when there is none
  std::optional<double> blur_px;  // scale of the Gaussian that its strong edges show
};

// An edge of contrast c that is blurred by a Gaussian of scale s has the slope c / (s sqrt(2 pi))
// where it is steepest; blur_px is the median over the strongest edges, up to about 6 px.
PictureQuality measureQuality(const TargetPicture& picture);

}  // namespace gyre
