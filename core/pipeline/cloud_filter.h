// Judges recovered points by what all views together know.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pipeline/options.h"
#include "core/scan/calibration.h"
#include "core/scan/frame.h"
#include "core/scan/point_cloud.h"
#include "core/scan/silhouette.h"

namespace gyre {

// The object's outline in every view so far, kept small: coarse and grown for judging points, finer
// as it is for what wants to know it. One thread at a time for addView(); any
// number for outsideShare().
class SilhouetteRecord {
 public:
  explicit SilhouetteRecord(const Calibration& calibration) : calibration_(calibration) {}

  // mask: 8 bit, non-zero on the object. A mask that covers the whole picture says nothing.
  void addView(const cv::Mat& mask, double table_angle_rad);

  // The same outlines with the table turned further by so much in each view added. [rad]
  SilhouetteRecord turned(std::span<const double> corrections_rad) const;

  // The outlines kept so far.
  Silhouettes silhouettes() const;

  // Share of the views in whose picture the point lies but misses the object's mask: a point of the
  // object does in none. Asks at most so many views, spread evenly.
  double outsideShare(const Eigen::Vector3d& point_in_table, std::size_t most_views) const;

 private:
  struct View {
    std::size_t added = 0;  // how many were added before
    Rigid3 cam_from_table;
    cv::Mat grown;     // a quarter of the size, 0 outside for certain
    cv::Mat as_it_is;  // as a Silhouette's
  };
  Calibration calibration_;
  std::size_t added_ = 0;
  std::vector<View> views_;
};

// How many views are asked about each point: a glance while the table turns, all of them at the
// end.
enum class Scrutiny : std::size_t { kGlance = 20, kFull = 100000 };

// 1 for every point to keep: certain enough, inside the outlines, and in company.
std::vector<std::uint8_t> judgePoints(const PointCloud& cloud, const SilhouetteRecord& silhouettes,
                                      const CloudOptions& options, Scrutiny scrutiny);

}  // namespace gyre
