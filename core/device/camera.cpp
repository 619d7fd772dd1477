// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/camera.h"

#include "core/base/clock.h"

namespace gyre {

Result<FramePtr> Camera::preview(const Task& task) { return grabAfter(steadySeconds(), task); }

}  // namespace gyre
