// Whether an object will scan well, told from a few pictures around it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"
#include "core/scan/calibration.h"
#include "core/scan/quick_look.h"

namespace gyre {

inline constexpr int kQuickViews = 8;

// Turns the table by one turn less a step, from where it stands, and takes a picture at each of the
// eight stops. The table may then be told to stand a whole turn back, where a scan begins the short
// way round; it is the same place. on_picture is called in this thread after each. A stop request
// slows the table down (kCancelled); its angle stays known.
Result<std::vector<FramePtr>> takeQuickLook(Turntable& turntable, Camera& camera,
                                            const std::function<void(const FramePtr&)>& on_picture,
                                            const Task& task);

// Judges pictures of the object, each at its table angle: whether it stays in the picture, is
// sharp, holds detail in its lights and shadows, and has texture enough to be followed. Without a
// picture of the empty table (null) object and platter are not told apart: then place and texture
// are not judged. Fails when there is no picture, when their size is not the calibration's, or when
// that has no cam_from_table.
Result<QuickLook> judgeQuickLook(const Calibration& calibration, const FramePtr& empty_table,
                                 const std::vector<FramePtr>& pictures, const Task& task);

}  // namespace gyre
