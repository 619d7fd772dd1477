// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_picture.h"

#include <opencv2/imgproc.hpp>

#include "core/calib/corners/picture_noise.h"
#include "core/calib/corners/saddle_fit.h"

namespace gyre {

Result<TargetPicture> targetPicture(const cv::Mat& image) {
  if (image.empty() || image.depth() != CV_8U) {
    return Error{Error::Code::kInvalidInput, "There is no picture of 8 bits to search.",
                 "Save the picture as JPEG or PNG in colour or grey."};
  }
  TargetPicture picture;
  switch (image.channels()) {
    case 1:
      picture.grey = image;
      break;
    case 3:
      cv::cvtColor(image, picture.grey, cv::COLOR_BGR2GRAY);
      break;
    case 4:
      cv::cvtColor(image, picture.grey, cv::COLOR_BGRA2GRAY);
      break;
    default:
      return Error{Error::Code::kInvalidInput, "The picture is neither in colour nor grey.",
                   "Save the picture as JPEG or PNG in colour or grey."};
  }
  picture.blurred = blurredForSaddles(picture.grey);
  picture.noise_grey = pictureNoise(picture.grey);
  return picture;
}

}  // namespace gyre
