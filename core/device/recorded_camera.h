// Pictures that were taken before, in the place of a camera: each later moment shows the next one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/device/camera.h"

namespace gyre {

// grabAfter() gives the next picture when the moment is later than that at which the present one
// was first given, else the present one again: whoever looks twice at one view sees it twice.
// kNotFound after the last one.
class RecordedCamera : public Camera {
 public:
  // The next picture is the one at the index, counted from 0. For a scan that goes on where it was
  // cut off.
  virtual void goTo(std::size_t index) = 0;
};

}  // namespace gyre
