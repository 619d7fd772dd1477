// Shows a growing cloud of points in pieces, so that no update stops the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/scan/point_cloud.h"
#include "ui/scene_pick.h"

class vtkRenderer;

namespace gyre {

enum class CloudColours { kNatural, kUncertainty };

// While the view moves, a machine that draws in software shows a thinned cloud.
enum class CloudDetail { kFull, kThinned };

enum class CloudVisibility { kShown, kHidden };

// Not a widget: fills a renderer. GUI thread only.
class CloudActors {
 public:
  explicit CloudActors(vtkRenderer& renderer);
  ~CloudActors();

  // Takes the cloud in place of the present one; fillNext() brings it onto the screen.
  void show(PointCloudPtr cloud, CloudColours colours);
  // Brings one piece of at most 65 536 points up to date. False when nothing was left to do.
  bool fillNext();

  void setDetail(CloudDetail detail);
  void setVisible(CloudVisibility visibility);
  void setPointSizePx(float size_px);

  // The point that is seen within a few pixels of that one (device pixels, y up).
  std::optional<ScenePick> pick(vtkRenderer& renderer, const Eigen::Vector2d& at_px);

  std::size_t size() const { return cloud_ ? cloud_->points.size() : 0; }
  Bounds bounds() const { return bounds_; }
  // The uncertainty drawn in the last colour of the scale. [mm]
  double worstShownSigmaMm() const { return worst_sigma_mm_; }

 private:
  struct Chunk;

  void addChunk();
  void fill(Chunk& chunk, std::size_t first) const;
  std::size_t stride() const;  // of the points that are shown

  vtkRenderer& renderer_;
  std::vector<std::unique_ptr<Chunk>> chunks_;
  PointCloudPtr cloud_;
  Bounds bounds_;
  CloudColours colours_ = CloudColours::kNatural;
  CloudDetail detail_ = CloudDetail::kFull;
  CloudVisibility visibility_ = CloudVisibility::kShown;
  std::size_t next_chunk_ = 0;
  double worst_sigma_mm_ = 0.1;
  float point_size_px_ = 3.0F;
};

// The colour of an uncertainty: share 0 is the best, 1 the worst of the scale.
Rgb uncertaintyColour(double share);

}  // namespace gyre
