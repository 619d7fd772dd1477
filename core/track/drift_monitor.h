// Tells during a scan when the camera was bumped, by what stands still around the table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/scan/drift.h"
#include "core/scan/frame.h"
#include "core/track/still_patches.h"

namespace gyre {

struct DriftOptions {
  // A smaller motion of the picture does no harm that could be measured. [px], > 0
  double least_px = 0.15;
  // How sure a motion must be. [sigma], > 0
  double least_sigma = 5.0;
};

// Needs no mask: a piece of the first picture belongs to what stands still when it is found again,
// in the one motion that most pieces share, in most views at which the table was turned elsewhere.
// The platter and the object look different there, and a person in the picture is not everywhere.
// Which pieces those are becomes surer with every view, and the first views are judged anew by it.
// One thread. The reasoning and its numbers: docs/algorithms/drift.md.
class DriftMonitor {
 public:
  explicit DriftMonitor(const DriftOptions& options = {}) : options_(options) {}

  // The first frame is what all others are held against. Frames of another size are not judged.
  void addFrame(const Frame& frame);

  // The last view, by what is known so far. Not judged before a second one.
  ViewDrift latest() const;

  // All views, by what is known now, with the sentence for the user.
  DriftReport report() const;

 private:
  struct View {
    int view = 0;
    bool turned_elsewhere = false;
    StillPatches::Motions motions;
    std::optional<SharedMotion> shared;  // of all pieces that were found
    std::vector<bool> shares;            // by piece
  };

  void measure(const cv::Mat& image_bgr, View& view);
  std::vector<bool> stillPieces() const;
  ViewDrift judged(const View& view, const std::vector<bool>& still) const;

  DriftOptions options_;
  std::optional<StillPatches> patches_;
  double first_angle_rad_ = 0.0;
  SharedMotion last_;
  std::vector<View> views_;
};

// How far a picture is moved against a reference of the same scene, whatever stands on the table:
// by the motion that most pieces of the reference share which are found again. Not judged when too
// few are, or when they share none.
ViewDrift pictureDrift(const cv::Mat& reference_bgr, const cv::Mat& image_bgr,
                       const DriftOptions& options = {});

}  // namespace gyre
