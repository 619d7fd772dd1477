// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/marker_detection.h"

#include <algorithm>

#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "core/scan/marker_dictionary.h"

namespace gyre {
namespace {

// The largest of each size contains what smaller ones hold, in the order of their release.
constexpr std::array<const char*, 5> kFamilies = {"DICT_4X4_1000", "DICT_5X5_1000", "DICT_6X6_1000",
                                                  "DICT_7X7_1000", "DICT_ARUCO_ORIGINAL"};
constexpr int kForeignEvidence = 3;

MarkerCorners cornersOf(const std::vector<cv::Point2f>& quadrangle) {
  MarkerCorners corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = {quadrangle[i].x, quadrangle[i].y};
  return corners;
}

// How far a code may be from what was read.
enum class Reading { kCorrecting, kExact };

Result<MarkerDetection> detect(const cv::Mat& grey, const std::string& dictionary,
                               Reading reading) {
  const auto known = markerDictionary(dictionary);
  if (!known) {
    return Error{Error::Code::kInvalidInput,
                 "Nobody knows the dictionary of codes '" + dictionary + "'.",
                 "Name one of OpenCV's ArUco dictionaries in the target file."};
  }
  try {
    std::vector<std::vector<cv::Point2f>> quadrangles;
    std::vector<std::vector<cv::Point2f>> rejected;
    std::vector<int> ids;
    const auto codes = cv::aruco::getPredefinedDictionary(known->opencv_number);
    const auto parameters = cv::aruco::DetectorParameters::create();
    if (reading == Reading::kExact) parameters->errorCorrectionRate = 0.0;
    cv::aruco::detectMarkers(grey, codes, quadrangles, ids, parameters, rejected);
    MarkerDetection detection;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      detection.markers.push_back({ids[i], cornersOf(quadrangles[i])});
    }
    std::stable_sort(detection.markers.begin(), detection.markers.end(),
                     [](const auto& a, const auto& b) { return a.id < b.id; });
    for (const auto& quadrangle : rejected) detection.unreadable.push_back(cornersOf(quadrangle));
    return detection;
  } catch (const cv::Exception& exception) {
    return Error{Error::Code::kInternal,
                 "Searching for codes failed: " + std::string(exception.what()), ""};
  }
}

}  // namespace

Result<MarkerDetection> detectMarkers(const cv::Mat& grey, const std::string& dictionary) {
  return detect(grey, dictionary, Reading::kCorrecting);
}

ForeignMarkers findForeignMarkers(const cv::Mat& grey, const std::string& but_not_dictionary) {
  // Five searches: on a picture that is no larger than it takes to read what people print.
  constexpr double kMostSide_px = 640.0;
  cv::Mat small = grey;
  const double scale = kMostSide_px / std::max({grey.cols, grey.rows, 1});
  if (scale < 1.0) cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  ForeignMarkers most;
  for (const char* family : kFamilies) {
    if (but_not_dictionary == family) continue;
    const auto detection = detect(small, family, Reading::kExact);
    if (!detection) continue;
    const int count = static_cast<int>(detection->markers.size());
    const int unread = static_cast<int>(detection->unreadable.size());
    // One in twenty dark squares is a code of the largest families by chance.
    if (count < kForeignEvidence || 3 * count < unread || count <= most.markers) continue;
    most = {family, count};
  }
  return most;
}

}  // namespace gyre
