// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/mesh/rigid_alignment.h"
#include "core/mesh/surface_index.h"
#include "core/mesh/surface_points.h"
#include "core/mesh/surface_samples.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 512;  // samples between two looks at the stop token: a millisecond
constexpr double kViewsSeen = 5.0;   // from so many views on, surface counts as seen
constexpr double kSameUnit = 0.05;   // two sizes differ by a unit, to so much
constexpr double kImpossibleRatio = 200.0;  // of sizes that are in one unit
constexpr std::array<std::pair<double, const char*>, 3> kUnits = {
    {{10.0, "centimetres"}, {25.4, "inches"}, {1000.0, "metres"}}};
constexpr int kBins = 40;                // of the histogram, up to its scale
constexpr double kLeastScale_mm = 1e-6;  // of a histogram of distances that are all zero
constexpr double kPlatterShare = 0.01;   // of the size: so near the platter nothing is judged

Error badInput(const std::string& what, const std::string& advice) {
  return {Error::Code::kInvalidInput, what, advice};
}

Result<void> checkSurface(const Mesh& mesh, const std::string& name) {
  if (mesh.vertices.empty()) {
    return badInput("The " + name + " holds no points.", "Give a cloud or a mesh with points.");
  }
  for (const MeshVertex& vertex : mesh.vertices) {
    if (!vertex.position.allFinite()) {
      return badInput("The " + name + " holds a coordinate that is not a number.",
                      "Write the file again with finite coordinates.");
    }
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= mesh.vertices.size()) {
        return badInput("A triangle of the " + name + " names a vertex that does not exist.",
                        "Write the file again from the program that made it.");
      }
    }
  }
  return {};
}

struct Distance {
  double mm = 0.0;
  bool counts = false;
};

// From each sample to the surface; counts when the surface there was seen by enough views.
Result<std::vector<Distance>> distances(const std::vector<SurfaceSample>& samples,
                                        const Mesh& surface, double min_views, const Task& task) {
  const SurfaceIndex index(surface);
  std::vector<Distance> found(samples.size());
  parallelFor(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      const SurfaceHit hit = index.nearest(samples[i].position);
      found[i] = {hit.distance_mm, index.viewsAt(hit) >= min_views};
    }
  });
  if (task.stopRequested()) return cancelled();
  return found;
}

std::vector<double> countedAscending(const std::vector<Distance>& all) {
  std::vector<double> counted;
  counted.reserve(all.size());
  for (const Distance& distance : all) {
    if (distance.counts) counted.push_back(distance.mm);
  }
  std::sort(counted.begin(), counted.end());
  return counted;
}

double shareWithin(const std::vector<double>& ascending, double d_mm) {
  const auto end = std::upper_bound(ascending.begin(), ascending.end(), d_mm);
  return static_cast<double>(end - ascending.begin()) / static_cast<double>(ascending.size());
}

// Linear between the two nearest ranks.
double quantile(const std::vector<double>& ascending, double q) {
  const double rank = q * static_cast<double>(ascending.size() - 1);
  const auto low = static_cast<std::size_t>(rank);
  const std::size_t high = std::min(low + 1, ascending.size() - 1);
  const double part = rank - static_cast<double>(low);
  return ascending[low] + part * (ascending[high] - ascending[low]);
}

// 1, 2 or 5 times a power of ten, not below the number.
double roundAbove(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (number <= step * power * (1.0 + 1e-12)) return step * power;
  }
  return 10.0 * power;
}

void fillHistogram(const std::vector<double>& ascending, double scale_mm, Comparison& comparison) {
  comparison.scale_mm =
      scale_mm > 0.0 ? scale_mm : roundAbove(std::max(kLeastScale_mm, quantile(ascending, 0.99)));
  comparison.max_mm = ascending.back();
  double below = 0.0;
  for (int i = 0; i < kBins; ++i) {
    ComparisonBin bin;
    bin.from_mm = comparison.scale_mm * i / kBins;
    bin.to_mm = comparison.scale_mm * (i + 1) / kBins;
    const double up_to = shareWithin(ascending, bin.to_mm);
    bin.share = up_to - below;
    below = up_to;
    comparison.histogram.push_back(bin);
  }
  if (below < 1.0) {
    comparison.histogram.push_back({comparison.scale_mm, comparison.max_mm, 1.0 - below});
  }
}

Comparison summarize(const std::vector<double>& to_reference, const std::vector<double>& to_result,
                     const CompareOptions& options) {
  Comparison comparison;
  comparison.samples = to_reference.size();
  for (const double mm : to_reference) comparison.mean_mm += mm;
  comparison.mean_mm /= static_cast<double>(to_reference.size());
  comparison.median_mm = quantile(to_reference, 0.5);
  comparison.p95_mm = quantile(to_reference, 0.95);
  fillHistogram(to_reference, options.scale_mm, comparison);
  for (const double d_mm : options.at_mm) {
    ComparisonAt at;
    at.d_mm = d_mm;
    at.precision = shareWithin(to_reference, d_mm);
    at.completeness = shareWithin(to_result, d_mm);
    const double sum = at.precision + at.completeness;
    at.f = sum > 0.0 ? 2.0 * at.precision * at.completeness / sum : 0.0;
    comparison.at.push_back(at);
  }
  return comparison;
}

Result<Comparison> compareInPlace(const Mesh& result, const Mesh& reference,
                                  const CompareOptions& options, const Task& task) {
  std::vector<SurfaceSample> on_result = sampleSurface(result, options.samples);
  std::erase_if(on_result, [&](const SurfaceSample& sample) {
    return sample.position.z() < options.min_height_mm;
  });
  std::vector<SurfaceSample> on_reference = sampleSurface(reference, options.samples);
  std::erase_if(on_reference,
                [&](const SurfaceSample& sample) { return sample.views < options.min_views_seen; });

  task.report(0.1, "Measuring distances");
  const auto accuracy = distances(on_result, reference, options.min_views_seen, task);
  if (!accuracy) return accuracy.error();
  task.report(0.55, "Measuring completeness");
  const auto completeness = distances(on_reference, result, 0.0, task);
  if (!completeness) return completeness.error();

  const std::vector<double> to_reference = countedAscending(*accuracy);
  const std::vector<double> to_result = countedAscending(*completeness);
  if (to_reference.empty() || to_result.empty()) {
    return Error{Error::Code::kTooFew, "Nothing of the two surfaces is left to compare.",
                 "Check that both are in millimetres, have an area, and lie in the same place."};
  }
  task.report(1.0, "Compared");
  return summarize(to_reference, to_result, options);
}

}  // namespace

Result<void> CompareOptions::validate() const {
  for (const double d_mm : at_mm) {
    if (!std::isfinite(d_mm) || d_mm <= 0.0) {
      return badInput("A distance to compare at is not a length above 0 mm.",
                      "Write lengths in millimetres, such as 0.25,0.5,1.");
    }
  }
  if (!std::isfinite(scale_mm) || scale_mm < 0.0) {
    return badInput("The scale of the colours is not a length above 0 mm.",
                    "Write a length in millimetres, such as 0.5.");
  }
  if (samples == 0) return badInput("Nothing can be compared with 0 samples.", "Take 1 or more.");
  return {};
}

Result<Comparison> compareSurfaces(const Mesh& result, const Mesh& reference,
                                   const CompareOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> valid = checkSurface(result, "result"); !valid) return valid.error();
  if (const Result<void> valid = checkSurface(reference, "reference"); !valid) return valid.error();
  if (options.alignment == Alignment::kNone) {
    return compareInPlace(result, reference, options, task);
  }
  task.report(0.0, "Aligning");
  const auto reference_from_result = alignRigidly(result, reference, task.part(0.0, 0.3));
  if (!reference_from_result) return reference_from_result.error();
  Mesh moved = result;
  for (MeshVertex& vertex : moved.vertices) {
    vertex.position = *reference_from_result * vertex.position;
  }
  auto comparison = compareInPlace(moved, reference, options, task.part(0.3, 1.0));
  if (comparison) comparison->reference_from_result = *reference_from_result;
  return comparison;
}

Result<std::vector<double>> vertexDistances(const Mesh& result, const Mesh& reference,
                                            const Task& task) {
  std::vector<SurfaceSample> places;
  places.reserve(result.vertices.size());
  for (const MeshVertex& vertex : result.vertices) places.push_back({vertex.position, 0.0});
  const auto found = distances(places, reference, 0.0, task);
  if (!found) return found.error();
  std::vector<double> distances_mm;
  distances_mm.reserve(found->size());
  for (const Distance& distance : *found) distances_mm.push_back(distance.mm);
  return distances_mm;
}

std::optional<UnitDoubt> unitDoubt(const Mesh& result, const Mesh& reference) {
  const double result_mm = boundsOf(result).diagonal();
  const double reference_mm = boundsOf(reference).diagonal();
  if (!(result_mm > 0.0) || !(reference_mm > 0.0)) return std::nullopt;
  const bool reference_smaller = reference_mm < result_mm;
  const double ratio = reference_smaller ? result_mm / reference_mm : reference_mm / result_mm;
  const char* unit = nullptr;
  for (const auto& [times, name] : kUnits) {
    if (std::abs(ratio / times - 1.0) < kSameUnit) unit = name;
  }
  const bool certain = ratio >= kImpossibleRatio;
  if (unit == nullptr && !certain) return std::nullopt;
  std::string text = formatted("The %s is %.4g times as large as the %s",
                               reference_smaller ? "result" : "reference", ratio,
                               reference_smaller ? "reference" : "result");
  text += unit != nullptr ? formatted(", which seems to be in %s.", unit)
                          : std::string(": they cannot both be in millimetres.");
  return UnitDoubt{
      {Error::Code::kInvalidInput, text, "Write both in millimetres, then compare again."},
      certain};
}

Mesh meshOfPoints(const PointCloud& cloud) {
  Mesh mesh;
  mesh.vertices.reserve(cloud.points.size());
  for (const Point& point : cloud.points) mesh.vertices.push_back(vertexOf(point));
  return mesh;
}

CompareOptions judgingOptions(const Mesh& reference) {
  CompareOptions options;
  options.min_views_seen = kViewsSeen;
  options.min_height_mm = kPlatterShare * boundsOf(reference).diagonal();
  return options;
}

}  // namespace gyre
