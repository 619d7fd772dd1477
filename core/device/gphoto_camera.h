// A still camera (DSLR or mirrorless) that takes one full picture for each view.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/device/camera.h"

namespace gyre {

struct GphotoOptions {
  // The longest that a picture may take from the shutter to here: long exposures, and a
  // library that waits long for a camera that finds no focus. [s], > 0
  double shot_timeout_s = 45.0;
  double open_timeout_s = 20.0;
};

// "gphoto:" is the camera on the USB cable, "gphoto:usb:001,004" the one of several at that port,
// "ptpip:HOST[:PORT]" one on the network.
bool namesGphoto(const std::string& camera);

// Opens it and asks who it is; takes no picture. kNotFound, kBusy, kTimeout, kIo. Its controls are
// what stands on the camera: read back, and told where they are automatic.
//
// grabAfter() fires the shutter once the moment has come. preview() gives the viewfinder's picture
// where the camera has one. A camera that was lost is opened anew at the next picture; a call that
// libgphoto2 does not come back from ends in kTimeout, and its result is dropped.
Result<std::unique_ptr<Camera>> openGphotoCamera(const std::string& camera,
                                                 const GphotoOptions& options = {});

}  // namespace gyre
