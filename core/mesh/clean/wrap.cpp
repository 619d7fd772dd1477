// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/wrap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/mesh/clean/alpha_wrap.h"
#include "core/mesh/clean/blend.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/draw_in.h"
#include "core/mesh/clean/quartered.h"
#include "core/mesh/clean/unseen_patch.h"
#include "core/mesh/components.h"
#include "core/mesh/edges.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/local_surface.h"
#include "core/mesh/surface_index.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

constexpr double kAlphaSpacings = 3.0;     // of the input's points
constexpr double kOffsetAlphas = 1.0 / 6;  // half a spacing
// Triangles of a mesh may be large where it is flat: alpha is at most the first and at least the
// second share of its size.
constexpr double kLargestAlpha = 1.0 / 30.0;
constexpr double kSmallestAlpha = 1.0 / 250.0;
constexpr double kMaxSteps = 600.0;  // of alpha over the input's size: some ten million triangles
constexpr double kReach = 1.25;      // of the offset: farther is not on the input
constexpr double kPointReach = 1.5;  // of the spacing, for the middles between points
constexpr std::size_t kNeighbours = 16;
constexpr std::size_t kGrain = 512;

Result<void> checkInput(const Mesh& input) {
  if (!input.triangles.empty()) return checkMesh(input);
  if (input.vertices.empty()) {
    return Error{Error::Code::kTooFew, "There is nothing to wrap.",
                 "Scan or open an object first."};
  }
  for (const MeshVertex& vertex : input.vertices) {
    if (vertex.position.allFinite()) continue;
    return Error{Error::Code::kInvalidInput, "The points hold a coordinate that is not a number.",
                 "Write the points again with finite coordinates."};
  }
  return {};
}

KdTree treeOf(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) positions.push_back(vertex.position);
  return KdTree(std::move(positions));
}

double meanEdge_mm(const Mesh& mesh) {
  double sum_mm = 0.0;
  for (const EdgeUse& use : edgeUses(mesh.triangles)) {
    sum_mm += (mesh.vertices[use.low].position - mesh.vertices[use.high].position).norm();
  }
  return sum_mm / static_cast<double>(3 * mesh.triangles.size());
}

Result<WrapSize> chooseSize(const Mesh& input, const WrapOptions& options, double spacing_mm) {
  WrapSize size{options.alpha_mm, options.offset_mm};
  const double diagonal_mm = boundsOf(input).diagonal();
  if (size.alpha_mm == 0.0) {
    size.alpha_mm = kAlphaSpacings * spacing_mm;
    if (!input.triangles.empty()) {
      size.alpha_mm =
          std::clamp(size.alpha_mm, kSmallestAlpha * diagonal_mm, kLargestAlpha * diagonal_mm);
    }
  }
  if (size.offset_mm == 0.0) size.offset_mm = kOffsetAlphas * size.alpha_mm;
  if (!(size.alpha_mm > 0.0)) {
    return Error{Error::Code::kTooFew, "All points lie in one place.",
                 "Choose the radius of the wrap, or scan the object again."};
  }
  if (diagonal_mm > kMaxSteps * size.alpha_mm) {
    return Error{Error::Code::kInvalidInput,
                 "So fine a wrap would need more than ten million triangles.",
                 "Choose a larger radius for it."};
  }
  return size;
}

// Where each vertex of the skin should go.
class Targets {
 public:
  Targets(const Mesh& input, const KdTree& tree, double offset_mm)
      : input_(input), tree_(tree), index_(input), offset_mm_(offset_mm) {}

  std::vector<Eigen::Vector3d> of(const Mesh& skin) const {
    std::vector<Eigen::Vector3d> targets(skin.vertices.size());
    parallelFor(targets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) targets[v] = of(skin.vertices[v]);
    });
    return targets;
  }

  double distance_mm(const Eigen::Vector3d& place) const {
    return index_.nearest(place).distance_mm;
  }

 private:
  // On a mesh the nearest place of it. Points are only samples: there the surface that those around
  // suggest, so that not all vertices gather on them. What is far goes in by the offset.
  Eigen::Vector3d of(const MeshVertex& vertex) const {
    const SurfaceHit hit = index_.nearest(vertex.position);
    const Eigen::Vector3d inwards = vertex.position - offset_mm_ * vertex.normal;
    if (hit.distance_mm > kReach * offset_mm_) return inwards;
    if (!input_.triangles.empty()) return hit.position;
    const auto surface =
        fitLocalSurface(tree_, vertex.position, tree_.nearest(vertex.position, kNeighbours));
    if (surface && (surface->foot - vertex.position).norm() <= kReach * offset_mm_) {
      return surface->foot;
    }
    return inwards;
  }

  const Mesh& input_;
  const KdTree& tree_;
  SurfaceIndex index_;
  double offset_mm_;
};

// Vertices far from the input become unseen, and triangles whose middle is get an unseen middle.
void markBridges(Mesh& skin, const Targets& targets, double reach_mm) {
  for (MeshVertex& vertex : skin.vertices) {
    if (targets.distance_mm(vertex.position) > reach_mm) vertex.seen = 0;
  }
  const auto bridges =
      std::stable_partition(skin.triangles.begin(), skin.triangles.end(), [&](const auto& corners) {
        const Eigen::Vector3d middle =
            (skin.vertices[corners[0]].position + skin.vertices[corners[1]].position +
             skin.vertices[corners[2]].position) /
            3.0;
        return targets.distance_mm(middle) <= reach_mm;
      });
  divideSeenTriangles(skin, static_cast<std::uint32_t>(bridges - skin.triangles.begin()));
}

}  // namespace

Result<WrappedMesh> wrapMesh(const Mesh& input, const WrapOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkInput(input); !checked) return checked.error();
  Mesh source = input;
  if (!source.triangles.empty()) removeUnusedVertices(source);
  const KdTree tree = treeOf(source);
  const double spacing_mm = median(localSpacing(tree));
  const Result<WrapSize> size = chooseSize(source, options, spacing_mm);
  if (!size) return size.error();

  task.report(0.0, "Wrapping");
  auto skin = alphaWrap(source, *size, task);
  if (!skin) return skin.error();
  // Alpha leaves triangles larger than what the input can tell.
  if (meanEdge_mm(*skin) > spacing_mm) *skin = quartered(*skin);
  computeNormals(*skin);
  const Targets targets(source, tree, size->offset_mm);
  const auto shares = drawIn(*skin, targets.of(*skin), task.part(0.4, 0.9));
  if (!shares) return shares.error();

  task.report(0.9, "Colouring the skin");
  carryAttributes(source, *skin);
  const double reach_mm = kReach * size->offset_mm;
  markBridges(*skin, targets,
              source.triangles.empty() ? std::max(reach_mm, kPointReach * spacing_mm) : reach_mm);
  computeNormals(*skin);
  if (task.stopRequested()) return cancelled();
  const auto all_the_way = std::count(shares->begin(), shares->end(), 1.0);
  return WrappedMesh{std::move(*skin), size->alpha_mm, size->offset_mm,
                     static_cast<double>(all_the_way) / static_cast<double>(shares->size())};
}

}  // namespace gyre
