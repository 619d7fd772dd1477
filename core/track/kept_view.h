// What is kept of a frame once it has been tracked: enough to look for points again.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/scan/frame.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// Half the size of the colour picture: brightness in full, colour at half the resolution, which is
// all that most cameras tell of it.
struct KeptView {
  cv::Mat grey;              // 8 bit, 1 channel
  cv::Mat chroma;            // Cr and Cb, 8 bit, half as wide and high
  double noise_sigma = 0.0;  // of the grey, in grey levels
};

// object_mask: 8 bit, the frame's size, non-zero where the noise counts. Thread: any.
KeptView keepView(const cv::Mat& image_bgr, const cv::Mat& object_mask);

// At the nearest pixel; pixels outside count as the nearest inside. Thread: any.
Rgb colourAt(const KeptView& view, const Eigen::Vector2d& pixel);

}  // namespace gyre
