// One still camera behind libgphoto2: plain calls that wait, one after the other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/scan/device_info.h"
#include "core/scan/frame.h"

namespace gyre {

// One thread uses it, but for giveUp(), which any thread may call: it makes the library leave the
// call in flight where it can. A call that loses the camera closes it; the next one opens it anew.
class GphotoLink {
 public:
  // word: see openGphotoCamera. Opens nothing yet. Fails when it is no such word.
  static Result<std::unique_ptr<GphotoLink>> forWord(const std::string& word);
  ~GphotoLink();
  GphotoLink(const GphotoLink&) = delete;
  GphotoLink& operator=(const GphotoLink&) = delete;

  // Finds the camera and asks who it is. kNotFound, kBusy, kIo.
  Result<CameraInfo> open();

  // Fires the shutter, fetches the picture at full size and removes it from the camera.
  // kGone, kIo, kRejected with the reason when it can only give raw pictures.
  Result<cv::Mat> shoot();

  // A picture of the viewfinder. kRejected when the camera has none.
  Result<cv::Mat> preview();

  // What the camera says of focus, exposure, aperture, gain and white balance. With kLock the focus
  // is set to manual where the camera lets programs do so.
  enum class Controls { kRead, kLock };
  Result<std::vector<ControlState>> controls(Controls what);

  void close();

  void giveUp() { giving_up_ = true; }

 private:
  struct Library;  // keeps libgphoto2's types out of this header

  explicit GphotoLink(std::string word);

  Result<void> ensureOpen();
  Error failed(int code, const std::string& doing);

  const std::string word_;
  std::atomic<bool> giving_up_ = false;
  std::unique_ptr<Library> library_;
};

}  // namespace gyre
