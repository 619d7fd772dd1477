// Shows a growing cloud of points in pieces, so that no update stops the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/cloud_actors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointPicker.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

namespace gyre {
namespace {

// One piece is filled in about 2 ms and uploaded in one go.
constexpr std::size_t kChunkPoints = 65536;
// What a processor draws in about 50 ms at two cores.
constexpr std::size_t kMovingBudget = 150000;

double percentile95Mm(const PointCloud& cloud) {
  constexpr std::size_t kSamples = 4096;
  const std::size_t stride = std::max<std::size_t>(1, cloud.points.size() / kSamples);
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    sigmas.push_back(cloud.points[i].sigmaMm());
  }
  if (sigmas.empty()) return 0.0;
  const auto at = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() * 95 / 100);
  std::nth_element(sigmas.begin(), at, sigmas.end());
  return *at;
}

}  // namespace

struct CloudActors::Chunk {
  vtkNew<vtkPolyData> shape;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
};

CloudActors::CloudActors(vtkRenderer& renderer) : renderer_(renderer) {
  // One point under the platter makes the driver compile its programs (0.1 s on a processor) with
  // the first picture, while nobody waits, and not when the first points of a scan come.
  PointCloud under_platter;
  under_platter.points.emplace_back();
  under_platter.points.back().position.z() = -0.6;
  under_platter.points.back().rgb = {128, 128, 128};
  cloud_ = std::make_shared<const PointCloud>(std::move(under_platter));
  addChunk();
  fill(*chunks_.front(), 0);
  cloud_ = nullptr;
}
CloudActors::~CloudActors() = default;

void CloudActors::show(PointCloudPtr cloud, CloudColours colours) {
  cloud_ = std::move(cloud);
  colours_ = colours;
  bounds_ = cloud_ ? boundsOf(*cloud_) : Bounds{};
  worst_sigma_mm_ = cloud_ ? std::max(percentile95Mm(*cloud_), 1e-3) : 0.1;
  next_chunk_ = 0;
}

bool CloudActors::fillNext() {
  const std::size_t needed = (size() + kChunkPoints - 1) / kChunkPoints;
  if (next_chunk_ < needed) {
    if (next_chunk_ == chunks_.size()) addChunk();
    fill(*chunks_[next_chunk_], next_chunk_ * kChunkPoints);
    ++next_chunk_;
    return true;
  }
  if (chunks_.size() == needed) return false;
  while (chunks_.size() > needed) {
    renderer_.RemoveActor(chunks_.back()->actor);
    chunks_.pop_back();
  }
  return true;
}

void CloudActors::addChunk() {
  auto chunk = std::make_unique<Chunk>();
  chunk->mapper->SetInputData(chunk->shape);
  chunk->actor->SetMapper(chunk->mapper);
  chunk->actor->GetProperty()->LightingOff();
  chunk->actor->GetProperty()->SetPointSize(point_size_px_);
  chunk->actor->SetVisibility(visibility_ == CloudVisibility::kShown ? 1 : 0);
  renderer_.AddActor(chunk->actor);
  chunks_.push_back(std::move(chunk));
}

void CloudActors::fill(Chunk& chunk, std::size_t first) const {
  const std::size_t count = std::min(kChunkPoints, size() - first);
  const std::size_t stride = this->stride();
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colours;
  vtkNew<vtkCellArray> cells;
  colours->SetNumberOfComponents(3);
  const auto shown = static_cast<vtkIdType>((count + stride - 1) / stride);
  points->SetNumberOfPoints(shown);
  colours->SetNumberOfTuples(shown);
  cells->InsertNextCell(static_cast<int>(shown));
  for (vtkIdType i = 0; i < shown; ++i) {
    const Point& point = cloud_->points[first + static_cast<std::size_t>(i) * stride];
    points->SetPoint(i, point.position.data());
    const Rgb rgb = colours_ == CloudColours::kNatural
                        ? point.rgb
                        : uncertaintyColour(point.sigmaMm() / worst_sigma_mm_);
    colours->SetTypedTuple(i, rgb.data());
    cells->InsertCellPoint(i);
  }
  chunk.shape->SetPoints(points);
  chunk.shape->SetVerts(cells);
  chunk.shape->GetPointData()->SetScalars(colours);
}

std::size_t CloudActors::stride() const {
  return detail_ == CloudDetail::kThinned ? size() / kMovingBudget + 1 : 1;
}

std::optional<ScenePick> CloudActors::pick(vtkRenderer& renderer, const Eigen::Vector2d& at_px) {
  constexpr double kTolerance = 0.006;  // of the window's diagonal
  if (size() == 0) return std::nullopt;
  vtkNew<vtkPointPicker> picker;
  picker->SetTolerance(kTolerance);
  picker->PickFromListOn();
  for (const auto& chunk : chunks_) picker->AddPickList(chunk->actor);
  if (picker->Pick(at_px.x(), at_px.y(), 0.0, &renderer) == 0) return std::nullopt;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (picker->GetActor() != chunks_[i]->actor) continue;
    const std::size_t index =
        i * kChunkPoints + static_cast<std::size_t>(picker->GetPointId()) * stride();
    if (index >= size()) return std::nullopt;
    return ScenePick{ScenePick::On::kPoint, index, cloud_->points[index].position};
  }
  return std::nullopt;
}

void CloudActors::setDetail(CloudDetail detail) {
  if (detail == detail_) return;
  detail_ = detail;
  if (size() > kMovingBudget) next_chunk_ = 0;
}

void CloudActors::setVisible(CloudVisibility visibility) {
  visibility_ = visibility;
  for (const auto& chunk : chunks_) {
    chunk->actor->SetVisibility(visibility == CloudVisibility::kShown ? 1 : 0);
  }
}

void CloudActors::setPointSizePx(float size_px) {
  point_size_px_ = size_px;
  for (const auto& chunk : chunks_) chunk->actor->GetProperty()->SetPointSize(size_px);
}

Rgb uncertaintyColour(double share) {
  // Blue, green, yellow, red: also told apart by lightness.
  constexpr std::array<std::array<double, 3>, 4> kScale = {
      {{44, 96, 190}, {54, 170, 130}, {240, 205, 70}, {205, 50, 45}}};
  const double at = std::clamp(share, 0.0, 1.0) * 3.0;
  const auto from = std::min<std::size_t>(static_cast<std::size_t>(at), 2);
  const double part = at - static_cast<double>(from);
  Rgb rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = static_cast<std::uint8_t>(
        std::lround(kScale[from][c] * (1.0 - part) + kScale[from + 1][c] * part));
  }
  return rgb;
}

}  // namespace gyre
