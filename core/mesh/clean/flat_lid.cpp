// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/flat_lid.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "core/mesh/kd_tree.h"

namespace gyre {
namespace {

constexpr std::uint32_t kNoNumber = 0xffffffffU;
constexpr int kUnknown = -1;
constexpr double kClearance = 0.6;    // of the spacing: how near a point between may lie to a loop
constexpr double kMaxPoints = 2.0e4;  // between the loops

struct PointNumber {
  std::uint32_t value = kNoNumber;
};
struct FaceDepth {
  int value = kUnknown;  // so many loops lie around it
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<PointNumber, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<FaceDepth, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

class LidBuilder {
 public:
  // False when loops cross.
  bool addLoops(const std::vector<PlaneLoop>& loops) {
    try {
      for (const PlaneLoop& loop : loops) addLoop(loop);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      return false;
    }
    lid_.on_loops = lid_.points.size();
    return true;
  }

  void addPointsBetween(double spacing_mm) {
    markDepths();
    std::vector<Eigen::Vector3d> on_loops;
    Bounds bounds;
    for (const Eigen::Vector2d& point : lid_.points) {
      on_loops.emplace_back(point.x(), point.y(), 0.0);
      bounds.include(on_loops.back());
    }
    const KdTree tree(std::move(on_loops));
    const Eigen::Vector3d size_mm = bounds.max - bounds.min;
    const double spacing = std::max(spacing_mm, std::sqrt(size_mm.x() * size_mm.y() / kMaxPoints));
    if (!(spacing > 0.0)) return;
    // Rows of equilateral triangles.
    const double row_mm = std::sqrt(0.75) * spacing;
    std::vector<Eigen::Vector2d> chosen;
    for (int row = 1; row * row_mm < size_mm.y(); ++row) {
      const double shift = row % 2 == 0 ? 0.0 : 0.5;
      for (int column = 0; (column + shift) * spacing < size_mm.x(); ++column) {
        const Eigen::Vector3d place =
            bounds.min + Eigen::Vector3d((column + shift) * spacing, row * row_mm, 0.0);
        const double clearance_mm2 = std::pow(kClearance * spacing, 2);
        if (tree.nearest(place, 1).front().squared_mm2 < clearance_mm2) continue;
        if (isWithin(place.head<2>())) chosen.emplace_back(place.head<2>());
      }
    }
    for (const Eigen::Vector2d& point : chosen) numberOf(point);
  }

  FlatLid build() {
    markDepths();
    for (const auto face : triangulation_.finite_face_handles()) {
      if (face->info().value % 2 == 0) continue;
      lid_.triangles.push_back({face->vertex(0)->info().value, face->vertex(1)->info().value,
                                face->vertex(2)->info().value});
    }
    return std::move(lid_);
  }

 private:
  Triangulation::Vertex_handle insert(const Eigen::Vector2d& point) {
    const auto vertex = triangulation_.insert(Kernel::Point_2(point.x(), point.y()));
    if (vertex->info().value == kNoNumber) {
      vertex->info().value = static_cast<std::uint32_t>(lid_.points.size());
      lid_.points.push_back(point);
    }
    return vertex;
  }
  std::uint32_t numberOf(const Eigen::Vector2d& point) { return insert(point)->info().value; }

  void addLoop(const PlaneLoop& loop) {
    std::vector<Triangulation::Vertex_handle> vertices;
    lid_.loops.emplace_back();
    for (const Eigen::Vector2d& point : loop) {
      vertices.push_back(insert(point));
      lid_.loops.back().push_back(vertices.back()->info().value);
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto next = vertices[(i + 1) % vertices.size()];
      if (vertices[i] != next) triangulation_.insert_constraint(vertices[i], next);
    }
  }

  bool isWithin(const Eigen::Vector2d& place) const {
    const auto face = triangulation_.locate(Kernel::Point_2(place.x(), place.y()));
    return face != nullptr && !triangulation_.is_infinite(face) && face->info().value % 2 == 1;
  }

  // Crossing a loop leads one level deeper, or out again: what counts is odd or even.
  void markDepths() {
    for (const auto face : triangulation_.all_face_handles()) face->info().value = kUnknown;
    if (triangulation_.dimension() < 2) return;
    std::deque<Triangulation::Face_handle> open = {triangulation_.infinite_face()};
    open.front()->info().value = 0;
    while (!open.empty()) {
      const auto face = open.front();
      open.pop_front();
      for (int side = 0; side < 3; ++side) {
        const auto next = face->neighbor(side);
        if (next->info().value != kUnknown) continue;
        const bool crosses = triangulation_.is_constrained({face, side});
        next->info().value = crosses ? 1 - face->info().value : face->info().value;
        open.push_back(next);
      }
    }
  }

  Triangulation triangulation_;
  FlatLid lid_;
};

}  // namespace

std::optional<FlatLid> fillLoops(const std::vector<PlaneLoop>& loops, double spacing_mm) {
  LidBuilder builder;
  if (!builder.addLoops(loops)) return std::nullopt;
  builder.addPointsBetween(spacing_mm);
  return builder.build();
}

}  // namespace gyre
