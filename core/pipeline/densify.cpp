// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/densify.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/point_surface.h"
#include "core/mesh/surface_seeds.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 32;
// A point found further from where it was expected than this share of the spacing lies on another
// surface, or on none.
constexpr double kMostOff = 0.7;
constexpr std::size_t kSilhouettesAsked = 20;
constexpr std::size_t kColoursAsked = 9;

Rgb colourOf(const DenseScene& scene, const Candidate& candidate) {
  std::vector<Rgb> colours;
  const std::size_t stride = candidate.observations.size() / kColoursAsked + 1;
  for (std::size_t i = 0; i < candidate.observations.size(); i += stride) {
    const Observation& seen = candidate.observations[i];
    colours.push_back(colourAt(scene.kept[static_cast<std::size_t>(seen.view)], seen.pixel));
  }
  return middleColour(colours);
}

class Grower {
 public:
  Grower(const DenseScene& scene, const ReconstructOptions& options, double spacing_mm)
      : scene_(scene), options_(options), spacing_mm_(spacing_mm) {}

  // The point at a place, from what was seen of it.
  std::optional<Candidate> find(const SurfaceSeed& seed, std::vector<Observation> seen) const;

 private:
  const DenseScene& scene_;
  const ReconstructOptions& options_;
  double spacing_mm_;
};

std::optional<Candidate> Grower::find(const SurfaceSeed& seed,
                                      std::vector<Observation> seen) const {
  if (static_cast<int>(seen.size()) < options_.recover.min_views) return std::nullopt;
  Candidate candidate;
  candidate.setObservations(scene_.camera, std::move(seen));
  for (Sighting& each : candidate.sightings) each.sigma = std::max(each.sigma, scene_.least_sigma);
  candidate.estimated = scene_.estimator.estimateFrom(candidate.sightings, seed.position);
  if (!candidate.estimated || !plausible(*candidate.estimated, options_)) return std::nullopt;
  const Eigen::Vector3d& position = candidate.estimated->position_in_table;
  if ((position - seed.position).norm() > kMostOff * spacing_mm_) return std::nullopt;
  if (scene_.silhouettes.outsideShare(position, kSilhouettesAsked) > options_.cloud.max_outside) {
    return std::nullopt;
  }
  candidate.rgb = colourOf(scene_, candidate);
  return candidate;
}

std::vector<SurfacePoint> placesToLookAt(const PointCloud& cloud,
                                         const std::vector<SurfaceSeed>& seeds) {
  std::vector<SurfacePoint> places;
  places.reserve(seeds.size());
  for (const SurfaceSeed& seed : seeds) {
    places.push_back({seed.position, seed.normal, seed.bending, cloud.points[seed.parent].views});
  }
  return places;
}

}  // namespace

Result<void> densify(const DenseScene& scene, const ReconstructOptions& options, PointCloud& cloud,
                     std::vector<Candidate>& candidates, const Task& task) {
  if (options.cloud.point_spacing_px <= 0.0 || cloud.points.empty()) return {};
  const double spacing_mm = options.cloud.point_spacing_px *
                            mmAPixel(scene.camera, scene.views.front().cam_from_table, cloud);
  const Grower grower(scene, options, spacing_mm);
  SurfaceSeeds places(spacing_mm);
  for (const Point& point : cloud.points) places.occupy(point);
  for (std::size_t first = 0; first < cloud.points.size();) {
    const std::size_t known = cloud.points.size();
    const std::vector<PointSurface> surfaces = pointSurfaces(cloud, first);
    for (std::size_t i = first; first > 0 && i < known; ++i) {
      if (!surfaces[i - first].normal.isZero()) cloud.points[i].normal = surfaces[i - first].normal;
    }
    const std::vector<SurfaceSeed> seeds = places.around(cloud, first, surfaces);
    const auto looked_at = placesToLookAt(cloud, seeds);
    auto seen = reobserve(scene.camera, scene.views, looked_at, options.track,
                          task.part(static_cast<double>(first) / static_cast<double>(known), 1.0));
    if (!seen) return seen.error();
    std::vector<std::optional<Candidate>> found(seeds.size());
    parallelFor(seeds.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        found[i] = grower.find(seeds[i], std::move((*seen)[i]));
      }
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) continue;
      Point point = pointOf(found[i]->rgb, found[i]->sightings, *found[i]->estimated);
      point.normal = seeds[i].normal;
      if (!places.take(point)) continue;
      cloud.points.push_back(std::move(point));
      candidates.push_back(std::move(*found[i]));
    }
    first = known;
  }
  return {};
}

}  // namespace gyre
