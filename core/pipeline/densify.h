// Grows points over the surface between the features.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/camera_model.h"
#include "core/pipeline/candidate.h"
#include "core/pipeline/cloud_filter.h"
#include "core/recover/point_estimator.h"
#include "core/scan/point_cloud.h"
#include "core/track/kept_view.h"
#include "core/track/reobservation.h"

namespace gyre {

struct DenseScene {
  const CameraModel& camera;
  std::span<const KeptView> kept;   // one a view
  std::span<const GreyView> views;  // the same, where the table truly stood
  const PointEstimator& estimator;  // with the same poses
  double least_sigma = 0.0;         // no sighting is believed beyond that; over the focal length
  const SilhouetteRecord& silhouettes;  // at the same angles
};

// Goes from the points that are known to places beside them on the surface they suggest, looks for
// these in every view (reobserve), and finds the points there, each by itself; from these further,
// until nothing new is found: over whatever has texture enough to be found again, corner or not.
// cloud: with normals; gains the points, in an order that depends on nothing but the input.
// candidates: one a point, gains what the points were found from. Fails when the task is stopped.
Result<void> densify(const DenseScene& scene, const ReconstructOptions& options, PointCloud& cloud,
                     std::vector<Candidate>& candidates, const Task& task);

}  // namespace gyre
