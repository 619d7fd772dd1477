// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/coded_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/calib/corners/saddle_fit.h"
#include "core/calib/match/marker_corners.h"
#include "core/calib/match/saddle_on_face.h"

namespace gyre {
namespace {

constexpr double kRoughSigma_px = 0.7;  // of a marker's corners as they are detected
constexpr std::size_t kNearPoints = 16;
constexpr double kSnap = 0.3;           // of a square
constexpr double kDiscOverClear = 0.8;  // what is left of the clear surroundings after the blur
// How far beyond what is known a prediction is trusted, in squares.
constexpr double kReach = 2.5;

struct SeenMarker {
  const TargetFace::Marker* printed = nullptr;
  MarkerCorners corners{};
  std::array<double, 4> sigma_px{};
};

std::vector<PlaneSighting> sightingsOf(const SeenMarker& marker) {
  std::vector<PlaneSighting> sightings;
  for (std::size_t k = 0; k < 4; ++k) {
    sightings.push_back(
        {marker.printed->corners_mm[k], marker.corners[k], 1.0 / marker.sigma_px[k]});
  }
  return sightings;
}

std::vector<SeenMarker> markersOfFace(const TargetPicture& picture, const TargetFace& face,
                                      std::span<const DetectedMarker> detected,
                                      int modules_a_side) {
  std::vector<SeenMarker> seen;
  for (const DetectedMarker& marker : detected) {
    const auto printed = std::find_if(face.markers.begin(), face.markers.end(),
                                      [&](const auto& each) { return each.id == marker.id; });
    if (printed == face.markers.end()) continue;
    SeenMarker one{&*printed, marker.corners, {}};
    one.sigma_px.fill(kRoughSigma_px);
    if (const auto refined = refineMarker(picture.grey, marker.corners, modules_a_side)) {
      one.corners = refined->corners;
      one.sigma_px = refined->sigma_px;
    }
    seen.push_back(one);
  }
  return seen;
}

// Whether two markers lie as they are printed: each says where the other's middle is, to half its
// side and more when it is far away.
bool agree(const SeenMarker& one, const SeenMarker& other) {
  const auto middle = [](const auto& corners) -> Eigen::Vector2d {
    return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  };
  const auto homography = fitHomography(sightingsOf(one));
  if (!homography) return false;
  const Eigen::Vector2d place = middle(other.printed->corners_mm);
  const double side_mm = (one.printed->corners_mm[1] - one.printed->corners_mm[0]).norm();
  const double sides = (place - middle(one.printed->corners_mm)).norm() / side_mm;
  const double side_px = (other.corners[2] - other.corners[0]).norm() / std::sqrt(2.0);
  const double miss = (throughHomography(*homography, place) - middle(other.corners)).norm();
  return miss < side_px * (0.4 + 0.15 * sides);
}

// Codes that were misread, or are of another copy of the target, stand alone: take them out.
void dropMisread(std::vector<SeenMarker>& seen) {
  if (seen.size() < 2) return;
  std::vector<int> votes(seen.size(), 0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = 0; j < seen.size(); ++j) {
      votes[i] += static_cast<int>(i != j && agree(seen[j], seen[i]));
    }
  }
  const int most = *std::max_element(votes.begin(), votes.end());
  std::vector<SeenMarker> kept;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (2 * votes[i] > most || (most == 0 && i == 0)) kept.push_back(seen[i]);
  }
  seen = std::move(kept);
}

bool inPicture(const TargetPicture& picture, const Eigen::Vector2d& pixel, double margin_px) {
  return pixel.x() >= margin_px && pixel.y() >= margin_px &&
         pixel.x() <= picture.grey.cols - 1 - margin_px &&
         pixel.y() <= picture.grey.rows - 1 - margin_px;
}

const TargetFace::Corner* cornerOf(const TargetFace& face, int point) {
  for (const auto& corner : face.corners) {
    if (corner.point == point) return &corner;
  }
  return nullptr;
}

std::vector<PlaneSighting> placesOf(const TargetFace& face, const FaceSearch& search) {
  std::vector<PlaneSighting> places;
  for (const PointSighting& sighting : search.sightings) {
    if (const auto* corner = cornerOf(face, sighting.point)) {
      places.push_back({corner->place_mm, sighting.pixel, 1.0 / sighting.sigma_px});
    }
  }
  return places;
}

double pitchOf_mm(const TargetFace& face) {
  return face.grid ? face.grid->pitch_mm.minCoeff() : face.corners.front().clear_mm;
}

enum class Finding { kFound, kOutside, kTooSmall, kUnseen };

Finding lookFor(const TargetPicture& picture, const TargetFace& face,
                const TargetFace::Corner& corner, std::span<const PlaneSighting> known,
                FaceSearch& search) {
  double nearest_mm = std::numeric_limits<double>::max();
  for (const auto& each : known) {
    nearest_mm = std::min(nearest_mm, (each.place - corner.place_mm).norm());
  }
  const double pitch_mm = pitchOf_mm(face);
  if (nearest_mm > kReach * pitch_mm) return Finding::kUnseen;
  const auto homography = fitHomographyNear(known, corner.place_mm, kNearPoints);
  if (!homography) return Finding::kUnseen;
  const Eigen::Vector2d predicted = throughHomography(*homography, corner.place_mm);
  if (!predicted.allFinite()) return Finding::kUnseen;
  if (!inPicture(picture, predicted, kLeastSaddleRadius_px + 2.0)) return Finding::kOutside;
  // Without coded squares the next edges are a whole square away: see fitSaddle().
  const double disc = face.markers.empty() ? 0.4 : kDiscOverClear;
  const SaddleOnFace known_corner{corner.place_mm, *homography, corner.clear_mm, disc};
  if (clearInPicture_px(known_corner) < kLeastClear_px) return Finding::kTooSmall;
  const auto saddle = measureSaddle(picture, known_corner);
  const double stretch = leastStretch(homographyJacobian(*homography, corner.place_mm));
  if (!saddle || (saddle->pixel - predicted).norm() > kSnap * stretch * pitch_mm) {
    return Finding::kUnseen;
  }
  search.sightings.push_back({corner.point, saddle->pixel, saddle->sigma_px});
  return Finding::kFound;
}

void tally(Finding finding, FaceSearch& search) {
  search.outside += static_cast<int>(finding == Finding::kOutside);
  search.too_small += static_cast<int>(finding == Finding::kTooSmall);
  search.unseen += static_cast<int>(finding == Finding::kUnseen);
}

// How far a sighting is from where its neighbours put it.
struct Disagreement {
  double miss_px = 0.0;
  double tolerance_px = 0.0;  // what waves in the paper and the bending of the lens explain
  double doubt = 1.0;         // above 1: the neighbours all lie to one side of it
};
Disagreement disagreement(const TargetFace& face, const PlaneSighting& sighting,
                          std::vector<PlaneSighting> others) {
  constexpr std::size_t kNeighbours = 12;
  constexpr double kLeast_px = 0.25;
  constexpr double kOfSquare = 0.03;
  Disagreement found;
  const auto homography = fitHomographyNear(others, sighting.place, kNeighbours);
  if (!homography) return found;
  const Eigen::Matrix2d jacobian = homographyJacobian(*homography, sighting.place);
  const double pitch_mm = pitchOf_mm(face);
  found.miss_px = (throughHomography(*homography, sighting.place) - sighting.pixel).norm();
  found.tolerance_px = std::max(kLeast_px, kOfSquare * pitch_mm * jacobian.norm() / std::sqrt(2.0));
  const std::size_t count = std::min(kNeighbours, others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
                    others.end(), [&](const PlaneSighting& a, const PlaneSighting& b) {
                      return (a.place - sighting.place).squaredNorm() <
                             (b.place - sighting.place).squaredNorm();
                    });
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < count; ++i) middle += others[i].place / static_cast<double>(count);
  found.doubt = 1.0 + (middle - sighting.place).norm() / pitch_mm;
  return found;
}

}  // namespace

std::optional<FaceSearch> searchCodedFace(const TargetPicture& picture, const TargetFace& face,
                                          std::span<const DetectedMarker> detected,
                                          int modules_a_side) {
  auto seen = markersOfFace(picture, face, detected, modules_a_side);
  dropMisread(seen);
  if (seen.empty()) return std::nullopt;
  FaceSearch search;
  search.face = face.index;
  for (const SeenMarker& marker : seen) {
    const auto guides = sightingsOf(marker);
    search.guides.insert(search.guides.end(), guides.begin(), guides.end());
  }
  // Saddles guide better and further than codes do: as long as more are found, more are looked for,
  // so that one code that could be read is enough for a whole face.
  constexpr int kMostRounds = 8;
  std::size_t before = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    completeFace(picture, face, search);
    dropStrays(face, search);
    if (round > 0 && search.sightings.size() <= before) break;
    before = search.sightings.size();
  }
  return search;
}

void completeFace(const TargetPicture& picture, const TargetFace& face, FaceSearch& search) {
  std::vector<PlaneSighting> known = placesOf(face, search);
  known.insert(known.end(), search.guides.begin(), search.guides.end());
  const std::vector<PointSighting> before = search.sightings;
  search.outside = search.too_small = search.unseen = 0;
  for (const auto& corner : face.corners) {
    const bool found = std::any_of(before.begin(), before.end(),
                                   [&](const auto& s) { return s.point == corner.point; });
    if (!found) tally(lookFor(picture, face, corner, known, search), search);
  }
  std::stable_sort(search.sightings.begin(), search.sightings.end(),
                   [](const auto& a, const auto& b) { return a.point < b.point; });
}

void dropStrays(const TargetFace& face, FaceSearch& search) {
  constexpr std::size_t kEnough = 6;
  while (!search.sightings.empty()) {
    const std::vector<PlaneSighting> places = placesOf(face, search);
    std::vector<double> misses;
    std::vector<double> tolerances;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<PlaneSighting> others = places;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      if (others.size() < kEnough) {
        others.insert(others.end(), search.guides.begin(), search.guides.end());
      }
      const Disagreement found = disagreement(face, places[i], others);
      misses.push_back(found.miss_px / found.doubt);
      tolerances.push_back(found.tolerance_px);
    }
    std::vector<double> sorted = misses;
    std::sort(sorted.begin(), sorted.end());
    const double spread_px = 3.0 * 1.4826 * sorted[sorted.size() / 2];
    const double guessing = places.size() < kEnough ? 4.0 : 1.0;
    std::size_t worst = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < misses.size(); ++i) {
      const double share = misses[i] / (guessing * std::max(tolerances[i], spread_px));
      if (share <= most) continue;
      most = share;
      worst = i;
    }
    if (most <= 1.0) return;
    search.sightings.erase(search.sightings.begin() + static_cast<std::ptrdiff_t>(worst));
    ++search.unseen;
  }
}

}  // namespace gyre
