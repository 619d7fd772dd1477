// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/acquisition.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/mesh/alpha_shape.h"
#include "core/mesh/compare.h"
#include "core/pipeline/live_reconstruction.h"
#include "core/pipeline/model_picture.h"
#include "core/sim/truth.h"

namespace gyre {
namespace {

constexpr int kSides = 3;  // that a figure shows
constexpr int kSideWidth_px = 640;
constexpr double kAround = 1.15;           // how much larger than the model a side is
constexpr double kComplete_percent = 1.0;  // of the size: what lies so near counts as found

struct Scanned {
  Reconstruction model;
  Mesh mesh;
  double seconds = 0.0;
};

std::int64_t stepsOf(const Renderer& renderer, int view, int views) {
  return renderer.rig().steps_per_turn * static_cast<std::int64_t>(view) / views;
}

Result<Scanned> scan(const Renderer& renderer, int views, const Task& task) {
  FramePtr empty = std::make_shared<const Frame>(renderer.render(0, TableLoad::kEmpty));
  auto live = LiveReconstruction::create(trueCalibration(renderer.rig()), empty);
  if (!live) return live.error();
  Scanned scanned;
  for (int view = 0; view < views; ++view) {
    if (task.stopRequested()) return cancelled();
    task.report(0.8 * view / views, "Scanning the " + renderer.rig().object);
    auto frame = std::make_shared<Frame>(
        renderer.render(stepsOf(renderer, view, views), TableLoad::kObject));
    frame->view = view;
    frame->table_angle_rad = kTurn_rad * view / views;
    const double start_s = steadySeconds();
    if (auto added = live->addFrame(frame); !added) return added.error();
    scanned.seconds += steadySeconds() - start_s;
  }
  const double start_s = steadySeconds();
  auto model = live->finish(task.part(0.8, 0.95));
  if (!model) return model.error();
  scanned.model = std::move(*model);
  auto surface = alphaShapeMesh(scanned.model.cloud, {}, task.part(0.95, 1.0));
  if (!surface) return surface.error();
  scanned.mesh = std::move(surface->mesh);
  scanned.seconds += steadySeconds() - start_s;
  return scanned;
}

// The part of the picture, 4 to 3, that holds the model from every side, with a little around it.
cv::Rect frameOf(const PointCloud& cloud, const Calibration& calibration, int views) {
  const CameraModel& camera = calibration.camera;
  cv::Point2d least(camera.width_px, camera.height_px);
  cv::Point2d most(0.0, 0.0);
  for (int side = 0; side < kSides; ++side) {
    const int view = views * side / kSides;
    const double angle_rad = kTurn_rad * view / views;
    const Rigid3 pose = camFromTable(*calibration.cam_from_table, angle_rad);
    for (const Point& point : cloud.points) {
      const auto pixel = camera.project(pose * point.position);
      if (!pixel) continue;
      least = {std::min(least.x, pixel->x()), std::min(least.y, pixel->y())};
      most = {std::max(most.x, pixel->x()), std::max(most.y, pixel->y())};
    }
  }
  const double width = kAround * std::max(most.x - least.x, (most.y - least.y) * 4.0 / 3.0);
  const cv::Point2d middle = 0.5 * (least + most);
  const cv::Rect wanted(static_cast<int>(middle.x - 0.5 * width),
                        static_cast<int>(middle.y - 0.375 * width), static_cast<int>(width),
                        static_cast<int>(0.75 * width));
  const cv::Rect all(0, 0, camera.width_px, camera.height_px);
  const cv::Rect frame = wanted & all;
  return frame.empty() ? all : frame;
}

cv::Mat figureOf(const Renderer& renderer, const Scanned& scanned, int views) {
  const Calibration calibration = trueCalibration(renderer.rig());
  const CameraModel& camera = calibration.camera;
  const cv::Rect frame = frameOf(scanned.model.cloud, calibration, views);
  const int height_px = kSideWidth_px * 3 / 4;
  cv::Mat figure(3 * height_px, kSides * kSideWidth_px, CV_8UC3);
  for (int side = 0; side < kSides; ++side) {
    const int view = views * side / kSides;
    const Rigid3 pose = camFromTable(*calibration.cam_from_table, kTurn_rad * view / views);
    const cv::Mat rows[] = {
        renderer.render(stepsOf(renderer, view, views), TableLoad::kObject).image_bgr,
        pictureOfPoints(scanned.model.cloud, camera, pose),
        pictureOfSurface(scanned.mesh, camera, pose)};
    for (int row = 0; row < 3; ++row) {
      cv::Mat place = figure({side * kSideWidth_px, row * height_px, kSideWidth_px, height_px});
      cv::resize(rows[row](frame), place, place.size(), 0.0, 0.0, cv::INTER_LINEAR);
    }
  }
  return figure;
}

ExperimentTable emptyTable(const AcquisitionOptions& options) {
  ExperimentTable table;
  table.name = "acquisition";
  table.caption = "Objects scanned on the simulated rig in " + std::to_string(options.views) +
                  " views of one turn, with its noise and motor errors and the true calibration: ";
  for (std::size_t i = 0; i < options.objects.size(); ++i) {
    if (i > 0) table.caption += ", ";
    table.caption += std::to_string(i + 1) + " " + options.objects[i];
  }
  table.caption +=
      ". Distances from the true surface in % of the object's size; completeness: the share of "
      "the surface that five views saw, nearer to the mesh than 1 % of the size. The paper shows "
      "pictures and gives no numbers.";
  table.columns = {{"object", "object"},
                   {"points", "points"},
                   {"points_median_percent", "points, median"},
                   {"points_p95_percent", "points, 95 %"},
                   {"mesh_median_percent", "mesh, median"},
                   {"mesh_p95_percent", "mesh, 95 %"},
                   {"mesh_complete_percent", "completeness of the mesh [%]"},
                   {"gap_px", "gap after the turn [px]"},
                   {"seconds", "time for computing [s]"}};
  table.drawing = {0, 0, {2, 3, 4, 5}, {}, "object", "distance from the truth [% of the size]"};
  return table;
}

Result<std::vector<std::optional<double>>> rowOf(const Renderer& renderer, const Scanned& scanned,
                                                 int views, const Task& task) {
  std::vector<std::int64_t> steps;
  steps.reserve(static_cast<std::size_t>(views));
  for (int view = 0; view < views; ++view) steps.push_back(stepsOf(renderer, view, views));
  const auto truth = truthOf(renderer, steps, task.part(0.0, 0.5));
  if (!truth) return truth.error();
  CompareOptions judging = judgingOptions(truth->mesh);
  judging.at_mm = {kComplete_percent / 100.0 * truth->size_mm};
  const auto points =
      compareSurfaces(meshOfPoints(scanned.model.cloud), truth->mesh, judging, task.part(0.5, 0.7));
  if (!points) return points.error();
  const auto mesh = compareSurfaces(scanned.mesh, truth->mesh, judging, task.part(0.7, 1.0));
  if (!mesh) return mesh.error();
  const double percent = 100.0 / truth->size_mm;
  std::vector<std::optional<double>> row = {static_cast<double>(scanned.model.cloud.points.size()),
                                            percent * points->median_mm,
                                            percent * points->p95_mm,
                                            percent * mesh->median_mm,
                                            percent * mesh->p95_mm,
                                            100.0 * mesh->at.front().completeness};
  row.push_back(scanned.model.turn_gap ? std::optional(scanned.model.turn_gap->px) : std::nullopt);
  row.emplace_back(scanned.seconds);
  return row;
}

}  // namespace

Result<Acquisition> acquisitionExperiment(const AcquisitionOptions& options, const Task& task) {
  if (options.objects.empty() || options.views < 3) {
    return Error{Error::Code::kInvalidInput, "There is no object to scan, or too few views.",
                 "Give at least one object and three views."};
  }
  Acquisition acquisition{emptyTable(options), {}};
  const auto count = static_cast<double>(options.objects.size());
  for (std::size_t i = 0; i < options.objects.size(); ++i) {
    RigSettings rig;
    rig.object = options.objects[i];
    rig.seed = options.seed;
    rig = atImageWidth(rig, options.image_width_px);
    if (auto valid = rig.validate(); !valid) return valid.error();
    const Renderer renderer(rig);
    const Task part =
        task.part(static_cast<double>(i) / count, (static_cast<double>(i) + 1.0) / count);
    const auto scanned = scan(renderer, options.views, part.part(0.0, 0.9));
    if (!scanned) return scanned.error();
    auto row = rowOf(renderer, *scanned, options.views, part.part(0.9, 1.0));
    if (!row) return row.error();
    row->insert(row->begin(), static_cast<double>(i + 1));
    acquisition.table.rows.push_back(std::move(*row));
    acquisition.figures.push_back(
        {"figure-" + rig.object, figureOf(renderer, *scanned, options.views)});
  }
  task.report(1.0, "Figures ready");
  return acquisition;
}

}  // namespace gyre
