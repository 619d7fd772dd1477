// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_hindrance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/calib/match/lattice_pose.h"
#include "core/calib/match/picture_quality.h"
#include "core/scan/marker_dictionary.h"

namespace gyre {
namespace {

constexpr double kBlurred_px = 2.0;      // scale of the edges' blur that hides codes and corners
constexpr double kDarkestBright = 60.0;  // grey level that the brightest hundredth must reach
constexpr double kLeastContrast = 25.0;  // grey levels
constexpr double kBlownShare = 0.25;     // of the picture at the top of the scale
constexpr double kSmallModule_px = 2.5;  // of a code's modules, which then blur into each other
constexpr double kSmallSquare_px = 8.0;
constexpr int kManyQuadrangles = 6;

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

std::string count(int number, const std::string& one, const std::string& many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

Error cutOff() {
  return {Error::Code::kTooFew, "The target is cut off by the edge of the picture.",
          "Move it to the middle, or the camera further away."};
}

Error tooSmall(double size_px, const std::string& what) {
  return {Error::Code::kTooFew,
          "The target is too small in the picture: its " + what + " are only about " +
              std::to_string(std::max(1L, std::lround(size_px))) + " px wide.",
          "Move the camera closer, zoom in, or choose a higher resolution."};
}

Error blurred(double blur_px) {
  return {Error::Code::kInvalidInput,
          "The picture is blurred: its edges are about " +
              std::to_string(std::lround(2.56 * blur_px)) + " px wide.",
          "Focus on the target and lock the focus; let the table stand still while a picture is "
          "taken."};
}

Error overExposed(double share) {
  return {Error::Code::kInvalidInput,
          "The picture is over-exposed: " + percent(share) +
              " of it is pure white, and no target shows in the rest.",
          "Shorten the exposure or dim the light until white paper is light grey."};
}

Error tooDark(const PictureQuality& quality) {
  return {Error::Code::kInvalidInput,
          "The picture is too dark: even its brightest parts reach only " +
              std::to_string(std::lround(quality.brightest)) + " of 255.",
          "Turn up the light or lengthen the exposure."};
}

Error tooFew(int found, int needed) {
  return {Error::Code::kTooFew,
          "Only " + count(found, "point", "points") + " of the target can be seen where " +
              std::to_string(needed) + " are needed.",
          "Clear what hides the target, and turn a printed face towards the camera."};
}

// What the picture as a whole lacks, if anything.
std::optional<Error> pictureFault(const TargetPicture& picture) {
  const PictureQuality quality = measureQuality(picture);
  if (quality.brightest < kDarkestBright) return tooDark(quality);
  if (quality.white_share > kBlownShare) return overExposed(quality.white_share);
  if (quality.blur_px && *quality.blur_px > kBlurred_px) return blurred(*quality.blur_px);
  if (quality.contrast < kLeastContrast) {
    return Error{Error::Code::kNotFound,
                 "No target is in the picture: it shows nothing with sharp edges.",
                 "Take off the lens cap, focus, and place the target in view."};
  }
  return std::nullopt;
}

double sideOf(const MarkerCorners& corners) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += 0.25 * (corners[(k + 1) % 4] - corners[k]).norm();
  return sum;
}

template <class Each>
double medianSide(const std::vector<Each>& quadrangles,
                  const MarkerCorners& (*corners)(const Each&)) {
  std::vector<double> sides;
  sides.reserve(quadrangles.size());
  for (const Each& each : quadrangles) sides.push_back(sideOf(corners(each)));
  std::sort(sides.begin(), sides.end());
  return sides[sides.size() / 2];
}

std::string idsOf(const MarkerDetection& detection) {
  std::string ids;
  constexpr std::size_t kMost = 4;
  for (std::size_t i = 0; i < std::min(kMost, detection.markers.size()); ++i) {
    ids += (i > 0 ? ", " : "") + std::to_string(detection.markers[i].id);
  }
  return detection.markers.size() > kMost ? ids + ", ..." : ids;
}

// How many markers of no face, all in one plane as those of a ring are, lie outside the picture.
int loosePointsOutside(const TargetPicture& picture, const Target& target,
                       const CodedSearch& search) {
  const std::vector<TargetPoint> points = pointsOf(target);
  std::vector<PlaneSighting> seen;
  for (const PointSighting& sighting : search.marker_sightings) {
    const auto& position = points[static_cast<std::size_t>(sighting.point)].position_in_target;
    seen.push_back({position.head<2>(), sighting.pixel, 1.0});
  }
  const auto homography = fitHomography(seen);
  if (!homography) return 0;
  int outside = 0;
  for (const TargetPoint& point : points) {
    if (point.marker_id < 0 ||
        std::abs(point.position_in_target.z() - points.front().position_in_target.z()) > 0.1) {
      continue;
    }
    const Eigen::Vector2d pixel =
        throughHomography(*homography, point.position_in_target.head<2>());
    outside += static_cast<int>(pixel.x() < 0.0 || pixel.y() < 0.0 ||
                                pixel.x() > picture.grey.cols - 1.0 ||
                                pixel.y() > picture.grey.rows - 1.0);
  }
  return outside;
}

// Codes of this target were read, but too few points came of it.
Error whyTooFew(const TargetPicture& picture, const Target& target, const CodedSearch& search,
                int needed) {
  const auto dictionary = markerDictionary(target.dictionary);
  const int modules = dictionary ? dictionary->modulesASide() : 7;
  int outside = loosePointsOutside(picture, target, search);
  int small = 0;
  int unseen = 0;
  for (const FaceSearch& face : search.faces) {
    outside += face.outside;
    small += face.too_small;
    unseen += face.unseen;
  }
  const auto& markers = search.detection.markers;
  bool at_border = false;
  for (const DetectedMarker& marker : markers) {
    for (const auto& corner : marker.corners) {
      const double reach = sideOf(marker.corners);
      at_border |= corner.x() < reach || corner.y() < reach ||
                   corner.x() > picture.grey.cols - 1 - reach ||
                   corner.y() > picture.grey.rows - 1 - reach;
    }
  }
  if (outside > std::max(small, unseen) || (at_border && outside > 0)) return cutOff();
  const double side_px = medianSide<DetectedMarker>(
      markers, [](const DetectedMarker& m) -> const MarkerCorners& { return m.corners; });
  if (small > unseen || side_px < kSmallModule_px * modules) {
    return tooSmall(side_px, "coded squares");
  }
  if (const auto fault = pictureFault(picture)) return *fault;
  if (at_border && search.faces.empty()) return cutOff();
  return tooFew(static_cast<int>(search.allSightings().size()), needed);
}

std::string sizeOf(const Eigen::Vector2i& size) {
  const Eigen::Vector2i sorted(size.minCoeff(), size.maxCoeff());
  return std::to_string(sorted.x()) + " x " + std::to_string(sorted.y());
}

bool reachesBorder(const TargetPicture& picture, const UncodedSearch& search) {
  for (const CornerLattice& lattice : search.lattices) {
    const double reach = 1.2 * squareHeight_px(lattice, search.corners);
    for (const LatticeNode& node : lattice.nodes) {
      const Eigen::Vector2d& at = search.corners[static_cast<std::size_t>(node.corner)].pixel;
      if (at.x() < reach || at.y() < reach || at.x() > picture.grey.cols - 1 - reach ||
          at.y() > picture.grey.rows - 1 - reach) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

Error whyCodedNotFound(const TargetPicture& picture, const Target& target,
                       const CodedSearch& search, int needed) {
  const auto dictionary = markerDictionary(target.dictionary);
  const int modules = dictionary ? dictionary->modulesASide() : 7;
  if (search.own_markers > 0) return whyTooFew(picture, target, search, needed);
  if (search.stranger_markers > 0) {
    return {Error::Code::kInvalidInput,
            "Another target is in the picture: its codes (" + idsOf(search.detection) +
                ") are not those of '" + target.name + "'.",
            "Place the chosen target, or choose the one that is on the table."};
  }
  // What another family codes is here a dark square that cannot be read.
  const ForeignMarkers foreign = search.detection.unreadable.size() < 2
                                     ? ForeignMarkers{}
                                     : findForeignMarkers(picture.grey, target.dictionary);
  if (foreign.markers > 0) {
    return {Error::Code::kInvalidInput,
            "Another target is in the picture: it carries " +
                count(foreign.markers, "code", "codes") + " of the family " + foreign.dictionary +
                " where '" + target.name + "' has " + target.dictionary + ".",
            "Place the chosen target, or choose the one that is on the table."};
  }
  if (const auto fault = pictureFault(picture)) return *fault;
  const auto& unreadable = search.detection.unreadable;
  if (static_cast<int>(unreadable.size()) >= kManyQuadrangles) {
    const double side_px = medianSide<MarkerCorners>(
        unreadable, [](const MarkerCorners& corners) -> const MarkerCorners& { return corners; });
    if (side_px < kSmallModule_px * modules) return tooSmall(side_px, "coded squares");
  }
  return {Error::Code::kNotFound, "No code of the target '" + target.name + "' is in the picture.",
          "Place the target in view of the camera, with its printed faces free."};
}

Error whyUncodedNotFound(const TargetPicture& picture, std::span<const TargetFace> faces,
                         const UncodedSearch& search, int needed) {
  if (search.assignment) {
    if (reachesBorder(picture, search)) return cutOff();
    return tooFew(static_cast<int>(search.allSightings().size()), needed);
  }
  if (!search.lattices.empty()) {
    const CornerLattice& largest = search.lattices.front();
    const bool fits_a_face = std::any_of(faces.begin(), faces.end(), [&](const auto& face) {
      return !waysToLay(largest, 0, face).empty();
    });
    if (!fits_a_face && largest.nodes.size() >= 9) {
      const auto face = std::find_if(faces.begin(), faces.end(),
                                     [](const auto& each) { return each.grid.has_value(); });
      std::string has =
          face == faces.end() ? "none" : sizeOf({face->grid->columns, face->grid->rows});
      return {Error::Code::kInvalidInput,
              "Another target is in the picture: a checkerboard of " + sizeOf(largest.size) +
                  " corners, where the faces of this one have " + has + ".",
              "Place the chosen target, or choose the one that is on the table; cover other "
              "checkered things."};
    }
    if (reachesBorder(picture, search)) return cutOff();
  }
  if (const auto fault = pictureFault(picture)) return *fault;
  std::vector<double> clear;
  for (const XCorner& corner : search.corners) clear.push_back(corner.clear_radius_px);
  std::sort(clear.begin(), clear.end());
  if (clear.size() >= 12 && clear[clear.size() / 2] < 0.6 * kSmallSquare_px) {
    return tooSmall(clear[clear.size() / 2], "squares");
  }
  if (!search.lattices.empty()) {
    return {
        Error::Code::kNotFound,
        "Checkered squares are in the picture, but they do not fit the target's faces together.",
        "Check that this is the chosen target and that no face is bent or loose."};
  }
  return {Error::Code::kNotFound, "No checkerboard is in the picture.",
          "Place the target in view of the camera, with its printed faces free."};
}

}  // namespace gyre
