// Pictures from a camera on the network: a phone, an IP camera, by HTTP or RTSP.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/device/frame_source.h"

namespace gyre {

struct StreamSourceOptions {
  double open_timeout_s = 5.0;  // until the first picture, > 0
  double read_timeout_s = 3.0;  // without a picture for so long, the connection is given up, > 0
  double retry_s = 0.5;         // between two tries to connect anew, > 0
};

// An address has "://" in it.
bool namesStream(const std::string& camera);

// url: http, https or rtsp; MJPEG or what else FFmpeg reads. Fails when nothing answers: kNotFound,
// kTimeout. Once open, the source lives through stalls, lost connections and cameras that come back
// later: meanwhile its grab() answers kTimeout and says what is wrong. A JPEG that came in half is
// refused and never shown. No sentence of it, nor its info(), ever shows a password in the URL.
Result<std::unique_ptr<FrameSource>> openStreamSource(const std::string& url,
                                                      const StreamSourceOptions& options = {});

}  // namespace gyre
