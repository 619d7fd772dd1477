// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/candidate.h"

#include <cmath>
#include <utility>

#include "core/base/median.h"

namespace gyre {

Candidate Candidate::ofTrack(const MeasuredTrack& track, const std::optional<Sighting>& returned) {
  Candidate candidate;
  candidate.seed = track.track.id;
  candidate.rgb = middleColour(track.colours);
  candidate.observations = track.track.observations;
  candidate.sightings = track.sightings;
  candidate.returned = returned;
  if (track.point) candidate.roughly_in_table = track.point->position_in_table;
  return candidate;
}

void Candidate::setObservations(const CameraModel& camera, std::vector<Observation> seen) {
  returned.reset();
  sightings.clear();
  sightings.reserve(seen.size());
  const double focal_px = std::sqrt(camera.fx * camera.fy);
  for (const Observation& each : seen) {
    sightings.push_back(
        {each.view, camera.normalizedFromPixel(each.pixel), each.sigma_px / focal_px});
  }
  observations = std::move(seen);
}

Rgb middleColour(std::span<const Rgb> colours) {
  Rgb middle{};
  if (colours.empty()) return middle;
  std::vector<std::uint8_t> values(colours.size());
  for (std::size_t channel = 0; channel < middle.size(); ++channel) {
    for (std::size_t i = 0; i < colours.size(); ++i) values[i] = colours[i][channel];
    middle[channel] = median(values);
  }
  return middle;
}

bool plausible(const EstimatedPoint& estimated, const ReconstructOptions& options) {
  // The platter's own texture scatters about its height: a point must be clearly above it.
  const double z_sigma = std::sqrt(estimated.covariance(2, 2));
  return estimated.agreeing >= options.recover.min_views &&
         estimated.chi2_per_freedom <= options.cloud.max_chi2 &&
         estimated.position_in_table.z() - 2.0 * z_sigma >= options.track.min_height_mm;
}

Point pointOf(const Rgb& rgb, std::span<const Sighting> sightings,
              const EstimatedPoint& estimated) {
  Point point;
  point.position = estimated.position_in_table;
  point.covariance = estimated.covariance;
  point.rgb = rgb;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (estimated.agrees[i] != 0) {
      point.views.push_back(static_cast<std::uint32_t>(sightings[i].view));
    }
  }
  return point;
}

double mmAPixel(const CameraModel& camera, const Rigid3& cam_from_table, const PointCloud& cloud) {
  std::vector<double> depths_mm;
  depths_mm.reserve(cloud.points.size());
  for (const Point& point : cloud.points) {
    depths_mm.push_back((cam_from_table * point.position).z());
  }
  return median(std::move(depths_mm)) / std::sqrt(camera.fx * camera.fy);
}

}  // namespace gyre
