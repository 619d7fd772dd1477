// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/quick_look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/base/clock.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/pipeline/edge_width.h"
#include "core/pipeline/exposure.h"
#include "core/pipeline/object_extent.h"
#include "core/pipeline/quick_words.h"
#include "core/pipeline/settling.h"
#include "core/scan/picture_size.h"
#include "core/track/empty_table_mask.h"
#include "core/track/feature_detector.h"
#include "core/track/grey_pyramid.h"
#include "core/track/moving_mask.h"
#include "core/track/track_gates.h"

namespace gyre {
namespace {

constexpr int kOutline_px = 4;       // the object's own edge is an edge, too
constexpr int kEdgeStrip_px = 3;     // masks end so near to the picture's edge
constexpr double kMeetsEdge = 0.01;  // of the edge's length: less is noise
// The tracker takes what is held to 0.2 px; noise alone makes a third of all places look so.
constexpr double kFirmlyHeld_px = 0.1;
constexpr double kBrighter = 0.9;  // quantile

// The same place, but counted so that the way to angle 0 is the short one.
Result<void> countTheShortWay(Turntable& turntable) {
  const double angle_rad = turntable.angleRad();
  const double short_rad = std::remainder(angle_rad, kTurn_rad);
  if (std::abs(short_rad - angle_rad) < 1e-9) return {};
  return turntable.setAngle(short_rad);
}

Result<std::vector<FramePtr>> turnAround(Turntable& turntable, Camera& camera,
                                         const std::function<void(const FramePtr&)>& on_picture,
                                         const Task& task) {
  const Task silent(task.stopToken());
  const double begin_rad = turntable.angleRad();
  Settling settling;
  std::vector<FramePtr> pictures;
  for (int view = 0; view < kQuickViews; ++view) {
    task.report(
        static_cast<double>(view) / kQuickViews,
        "Quick look, picture " + std::to_string(view + 1) + " of " + std::to_string(kQuickViews));
    if (view > 0) {
      const auto moved = turntable.moveTo(begin_rad + kTurn_rad * view / kQuickViews, silent);
      if (!moved) return moved.error();
    }
    const auto picture = settling.grabStill(camera, steadySeconds(), silent);
    if (!picture) return picture.error();
    Frame frame = **picture;
    frame.view = view;
    frame.table_angle_rad = turntable.angleRad();
    pictures.push_back(std::make_shared<const Frame>(std::move(frame)));
    on_picture(pictures.back());
  }
  return pictures;
}

std::string edgesMet(const cv::Mat& mask) {
  const int w = mask.cols;
  const int h = mask.rows;
  const int strip = std::min({kEdgeStrip_px, w, h});
  const auto meets = [&](const cv::Rect& edge) {
    const double length = std::max(edge.width, edge.height);
    cv::Mat across;
    cv::reduce(mask(edge), across, edge.width > edge.height ? 0 : 1, cv::REDUCE_MAX);
    return cv::countNonZero(across) > kMeetsEdge * length;
  };
  std::string met;
  const auto add = [&met](const char* name) {
    met += (met.empty() ? "" : ", ") + std::string(name);
  };
  if (meets({0, 0, strip, h})) add("left");
  if (meets({w - strip, 0, strip, h})) add("right");
  if (meets({0, 0, w, strip})) add("top");
  if (meets({0, h - strip, w, strip})) add("bottom");
  return met;
}

// Lost pixels of the object, and the brightness that its brighter tenth has.
void lookAtExposure(const cv::Mat& image_bgr, const cv::Mat& mask, QuickView& view) {
  const Exposure exposure = exposureOf(image_bgr, mask);
  view.white_share = exposure.too_bright;
  view.black_share = exposure.too_dark;
  std::vector<std::uint8_t> greys;
  const cv::Mat grey = greyOf(image_bgr);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      if (mask.at<std::uint8_t>(row, column) != 0)
        greys.push_back(grey.at<std::uint8_t>(row, column));
    }
  }
  const auto at = greys.begin() +
                  static_cast<std::ptrdiff_t>(kBrighter * static_cast<double>(greys.size() - 1));
  std::nth_element(greys.begin(), at, greys.end());
  view.brightness = *at;
}

// Share of the places where the tracker would look that give it something to follow.
double texturedShare(const cv::Mat& image_bgr, const cv::Mat& mask) {
  TrackOptions options;
  options.max_sigma_px = kFirmlyHeld_px;
  const cv::Mat allowed = allowedArea(mask, options);
  const double places = static_cast<double>(cv::countNonZero(allowed)) /
                        (options.feature_spacing_px * options.feature_spacing_px);
  if (places < 1.0) return 0.0;
  const cv::Mat grey = greyOf(image_bgr);
  const auto found = detectFeatures(grey, estimateNoiseSigma(grey, allowed), allowed, {}, options);
  return std::min(1.0, static_cast<double>(found.size()) / places);
}

QuickView lookAt(const FramePtr& picture, const cv::Mat& mask) {
  QuickView view;
  view.picture = picture;
  const cv::Mat& image = picture->image_bgr;
  view.object_share =
      static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
  if (cv::countNonZero(mask) == 0) return view;
  cv::Mat with_outline;
  cv::dilate(mask, with_outline, cv::Mat(), {-1, -1}, kOutline_px);
  view.edge_width_px = edgeWidthPx(image, with_outline);
  lookAtExposure(image, mask, view);
  view.textured_share = texturedShare(image, mask);
  return view;
}

std::vector<cv::Mat> masksOf(const Calibration& calibration, const FramePtr& empty_table,
                             const std::vector<FramePtr>& pictures) {
  std::vector<cv::Mat> masks(pictures.size());
  if (empty_table) {
    const EmptyTableMask mask(calibration, empty_table);
    parallelFor(pictures.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) masks[i] = mask.maskOf(*pictures[i]);
    });
    return masks;
  }
  MovingMask mask;
  for (const FramePtr& picture : pictures) (void)mask.addFrame(*picture);
  for (std::size_t i = 0; i < pictures.size(); ++i) masks[i] = mask.addFrame(*pictures[i]);
  return masks;
}

Result<void> checkPictures(const Calibration& calibration, const FramePtr& empty_table,
                           const std::vector<FramePtr>& pictures) {
  if (!calibration.cam_from_table) {
    return Error{Error::Code::kInvalidInput, "The camera's place at the table is not known.",
                 "Calibrate first, with the target on the turning table."};
  }
  if (pictures.empty()) {
    return Error{Error::Code::kInvalidInput, "There are no pictures to judge.", ""};
  }
  const auto fits = [&](const FramePtr& frame, const char* subject_has) {
    return checkCalibratedSize({frame->image_bgr.cols, frame->image_bgr.rows}, calibration.camera,
                               subject_has);
  };
  if (empty_table) {
    auto fit = fits(empty_table, "The picture of the empty table has");
    if (!fit) return fit;
  }
  for (const FramePtr& picture : pictures) {
    if (auto fit = fits(picture, "The camera's pictures have"); !fit) return fit;
  }
  return {};
}

}  // namespace

Result<std::vector<FramePtr>> takeQuickLook(Turntable& turntable, Camera& camera,
                                            const std::function<void(const FramePtr&)>& on_picture,
                                            const Task& task) {
  auto pictures = turnAround(turntable, camera, on_picture, task);
  if (!pictures) {
    turntable.stop();
    return pictures;
  }
  if (auto counted = countTheShortWay(turntable); !counted) return counted.error();
  return pictures;
}

Result<QuickLook> judgeQuickLook(const Calibration& calibration, const FramePtr& empty_table,
                                 const std::vector<FramePtr>& pictures, const Task& task) {
  if (auto fit = checkPictures(calibration, empty_table, pictures); !fit) return fit.error();
  task.report(0.0, "Judging the pictures");
  const std::vector<cv::Mat> masks = masksOf(calibration, empty_table, pictures);
  if (task.stopRequested()) return cancelled();
  QuickLook look;
  look.views.resize(pictures.size());
  parallelFor(pictures.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !task.stopRequested(); ++i) {
      look.views[i] = lookAt(pictures[i], masks[i]);
      if (empty_table) look.views[i].leaves_at = edgesMet(masks[i]);
    }
  });
  if (task.stopRequested()) return cancelled();
  std::optional<ObjectExtent> extent;
  if (empty_table) {
    std::vector<SeenOutline> outlines;
    for (std::size_t i = 0; i < masks.size(); ++i) {
      outlines.push_back({pictures[i]->table_angle_rad, masks[i]});
    }
    extent = objectExtent(calibration, outlines);
  }
  putIntoWords(empty_table ? OutlinesKnown::kYes : OutlinesKnown::kNo, extent, look);
  return look;
}

}  // namespace gyre
