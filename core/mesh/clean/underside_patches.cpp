// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/underside_patches.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>

#include "core/mesh/clean/plate_heights.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/underside.h"

namespace gyre {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Places = UndersidePatches::Places;

// Lengths in edges of the new triangles.
constexpr double kDividedEdges = 2.0;  // what is longer is divided before anything moves
constexpr unsigned kEvenRounds = 5;
constexpr double kSparedEdges = 2.0;   // around a crossing
constexpr double kStillDown = -0.05;   // z of a normal
constexpr double kReachEdges = 3.0;    // around a place at the rim, for the slope there
constexpr double kAboveTable = 0.1;    // how near to the table's level the bend may come
constexpr int kMaxYields = 24;         // rounds of bending less
constexpr double kYieldedEdges = 2.0;  // around a crossing
constexpr double kLeastBend = 0.1;     // a smaller share is none
constexpr int kSpreads = 4;            // how far a smaller bend makes its neighbours smaller

bool nearAny(const Eigen::Vector3d& at, const Places& places, double within_mm) {
  return std::any_of(places.begin(), places.end(), [&](const Eigen::Vector3d& other) {
    return (at - other).squaredNorm() < within_mm * within_mm;
  });
}

}  // namespace

// The surface with what is known of its parts.
class UndersidePatches::Body {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Vertex = SurfaceMesh::Vertex_index;
  using Face = SurfaceMesh::Face_index;
  using Edge = SurfaceMesh::Edge_index;

  Body(const VertexOrigins& vertex_origins, const std::vector<std::uint32_t>& triangles,
       double new_edge_mm)
      : surface_(surfaceMeshOf<SurfaceMesh>(vertex_origins.mesh())),
        origins_(vertex_origins),
        level_mm_(tableLevel_mm(vertex_origins.mesh())),
        edge_mm_(new_edge_mm) {
    addProperties();
    for (const std::uint32_t t : triangles) in_[Face(t)] = 1;
    findRim();
  }
  Body(const Body& other)
      : surface_(other.surface_),
        origins_(other.origins_),
        level_mm_(other.level_mm_),
        edge_mm_(other.edge_mm_) {
    addProperties();
  }
  Body& operator=(const Body&) = delete;
  ~Body() = default;

  const SurfaceMesh& surface() const { return surface_; }
  bool isIn(Face face) const { return in_[face] != 0; }
  bool isFixed(Vertex vertex) const { return fixed_[vertex]; }

  std::uint32_t originOf(Vertex vertex) const { return origins_.at(placeOf(vertex)); }

  Eigen::Vector3d placeOf(Vertex vertex) const {
    const auto& point = surface_.point(vertex);
    return {point.x(), point.y(), point.z()};
  }

  void divide() {
    std::vector<Edge> edges;
    for (const Edge edge : surface_.edges()) {
      const auto half = surface_.halfedge(edge);
      if (isInside(half) && isInside(surface_.opposite(half))) edges.push_back(edge);
    }
    pmp::split_long_edges(edges, kDividedEdges * edge_mm_, surface_);
    spreadFromRim();
  }

  void even() {
    pmp::isotropic_remeshing(facesIn(), edge_mm_, surface_,
                             CGAL::parameters::number_of_iterations(kEvenRounds)
                                 .edge_is_constrained_map(rim_)
                                 .vertex_is_constrained_map(fixed_)
                                 .face_patch_map(in_)
                                 .collapse_constraints(false)
                                 .number_of_relaxation_steps(3U));
    findRim();
  }

  Places crossings() const {
    std::vector<std::pair<Face, Face>> pairs;
    pmp::self_intersections(facesNear(), surface_, std::back_inserter(pairs));
    Places places;
    for (const auto& [a, b] : pairs) {
      if (!isIn(a) && !isIn(b)) continue;
      places.push_back(middleOf(isIn(a) ? a : b));
    }
    return places;
  }

  Places spoilt() const {
    Places places;
    for (const Face face : facesIn()) {
      if (normalOf(face).z() > kStillDown) places.push_back(middleOf(face));
    }
    const std::vector<MeshVertex>& before = origins_.mesh().vertices;
    std::vector<char> found(before.size(), 0);
    for (const Vertex vertex : surface_.vertices()) {
      if (const std::uint32_t origin = originOf(vertex); origin != VertexOrigins::kNone)
        found[origin] = 1;
    }
    for (std::size_t v = 0; v < before.size(); ++v) {
      if (found[v] == 0 && before[v].seen != 0) places.push_back(before[v].position);
    }
    return places;
  }

  void spare(const Places& places) {
    for (const Face face : facesIn()) {
      if (nearAny(middleOf(face), places, kSparedEdges * edge_mm_)) in_[face] = 0;
    }
    findRim();
  }

  std::vector<Vertex> inner() const {
    std::vector<Vertex> found;
    for (const Vertex vertex : surface_.vertices()) {
      if (!fixed_[vertex]) found.push_back(vertex);
    }
    return found;
  }

  double bend(const RimSlopes& slopes, std::size_t allowed, const Task& task) {
    const std::vector<Vertex> vertices = inner();
    const std::optional<std::vector<double>> heights = plateHeights(plateOf(slopes));
    if (!heights) return 0.0;
    std::vector<double> flat_mm;
    std::vector<double> by_mm;
    for (const Vertex vertex : vertices) {
      flat_mm.push_back(placeOf(vertex).z());
      const double height_mm = (*heights)[number_[vertex]];
      by_mm.push_back(std::max(height_mm, level_mm_ + kAboveTable * edge_mm_) - flat_mm.back());
    }
    std::vector<double> share(vertices.size(), 1.0);
    for (int round = 0; round < kMaxYields && !task.stopRequested(); ++round) {
      double most_mm = 0.0;
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        most_mm = std::max(most_mm, std::abs(share[i] * by_mm[i]));
        lift(vertices[i], flat_mm[i] + share[i] * by_mm[i]);
      }
      const Places crossed = crossings();
      if (crossed.size() <= allowed) return most_mm;
      yield(vertices, crossed, share);
    }
    return 0.0;
  }

 private:
  void addProperties() {
    in_ = surface_.add_property_map<Face, int>("f:underside", 0).first;
    rim_ = surface_.add_property_map<Edge, bool>("e:rim", false).first;
    fixed_ = surface_.add_property_map<Vertex, bool>("v:fixed", true).first;
    number_ =
        surface_.add_property_map<Vertex, std::uint32_t>("v:number", VertexOrigins::kNone).first;
  }

  bool isInside(SurfaceMesh::Halfedge_index half) const {
    return !surface_.is_border(half) && isIn(surface_.face(half));
  }

  bool isMeasured(Vertex vertex) const {
    const std::uint32_t origin = originOf(vertex);
    return origin != VertexOrigins::kNone && origins_.mesh().vertices[origin].seen != 0;
  }

  // Edges with the patch on one side only are rims; what is measured or not wholly in a patch
  // stays.
  void findRim() {
    for (const Edge edge : surface_.edges()) {
      const auto half = surface_.halfedge(edge);
      rim_[edge] = isInside(half) != isInside(surface_.opposite(half));
    }
    for (const Vertex vertex : surface_.vertices()) {
      bool wholly = !surface_.is_isolated(vertex) && !isMeasured(vertex);
      if (wholly) {
        for (const auto half : surface_.halfedges_around_target(surface_.halfedge(vertex))) {
          wholly = wholly && isInside(half);
        }
      }
      fixed_[vertex] = !wholly;
    }
  }

  // Triangles that came to lie between others of a patch belong to it.
  void spreadFromRim() {
    std::vector<Face> open = facesIn();
    while (!open.empty()) {
      const Face face = open.back();
      open.pop_back();
      for (const auto half : surface_.halfedges_around_face(surface_.halfedge(face))) {
        const auto other = surface_.opposite(half);
        if (rim_[surface_.edge(half)] || surface_.is_border(other)) continue;
        const Face next = surface_.face(other);
        if (isIn(next)) continue;
        in_[next] = 1;
        open.push_back(next);
      }
    }
    findRim();
  }

  std::vector<Face> facesIn() const {
    std::vector<Face> faces;
    for (const Face face : surface_.faces()) {
      if (isIn(face)) faces.push_back(face);
    }
    return faces;
  }

  Bounds boundsOfFace(Face face) const {
    Bounds bounds;
    for (const Vertex vertex : surface_.vertices_around_face(surface_.halfedge(face))) {
      bounds.include(placeOf(vertex));
    }
    return bounds;
  }

  // All that a patch could meet.
  std::vector<Face> facesNear() const {
    Bounds patches;
    for (const Face face : facesIn()) {
      const Bounds bounds = boundsOfFace(face);
      patches.include(bounds.min);
      patches.include(bounds.max);
    }
    std::vector<Face> faces;
    for (const Face face : surface_.faces()) {
      const Bounds bounds = boundsOfFace(face);
      if ((bounds.min.array() <= patches.max.array()).all() &&
          (bounds.max.array() >= patches.min.array()).all()) {
        faces.push_back(face);
      }
    }
    return faces;
  }

  Eigen::Vector3d normalOf(Face face) const {
    const auto half = surface_.halfedge(face);
    const Eigen::Vector3d a = placeOf(surface_.source(half));
    const Eigen::Vector3d b = placeOf(surface_.target(half));
    const Eigen::Vector3d c = placeOf(surface_.target(surface_.next(half)));
    return (b - a).cross(c - a).stableNormalized();
  }

  Eigen::Vector3d middleOf(Face face) const {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Vertex vertex : surface_.vertices_around_face(surface_.halfedge(face))) {
      middle += placeOf(vertex) / 3.0;
    }
    return middle;
  }

  void lift(Vertex vertex, double to_mm) {
    const auto& at = surface_.point(vertex);
    surface_.point(vertex) = {at.x(), at.y(), to_mm};
  }

  // The patches as a plate, with the slopes of what was measured at their rims.
  Plate plateOf(const RimSlopes& slopes) {
    Plate plate;
    for (const Face face : facesIn()) {
      Triangle triangle{};
      std::size_t corner = 0;
      for (const Vertex vertex : surface_.vertices_around_face(surface_.halfedge(face))) {
        if (number_[vertex] == VertexOrigins::kNone) {
          number_[vertex] = static_cast<std::uint32_t>(plate.places.size());
          plate.places.push_back(placeOf(vertex));
          plate.held.push_back(fixed_[vertex] ? 1 : 0);
        }
        triangle[corner++] = number_[vertex];
      }
      plate.triangles.push_back(triangle);
    }
    plate.slopes.resize(plate.places.size());
    for (const Edge edge : surface_.edges()) {
      if (!rim_[edge]) continue;
      for (const int end : {0, 1}) {
        const Vertex vertex = surface_.vertex(edge, static_cast<unsigned>(end));
        auto& slope = plate.slopes[number_[vertex]];
        if (!slope) slope = slopes.at(placeOf(vertex), kReachEdges * edge_mm_);
      }
    }
    return plate;
  }

  // Halves the bend near crossings, and evens out how it falls off around them.
  void yield(const std::vector<Vertex>& vertices, const Places& crossed,
             std::vector<double>& share) const {
    std::vector<double> of(surface_.num_vertices(), 0.0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      double& mine = of[vertices[i]];
      mine = share[i];
      if (!nearAny(placeOf(vertices[i]), crossed, kYieldedEdges * edge_mm_)) continue;
      mine = mine < kLeastBend ? 0.0 : 0.5 * mine;
    }
    for (int spread = 0; spread < kSpreads; ++spread) {
      const std::vector<double> before = of;
      for (const Vertex vertex : vertices) {
        double sum = 0.0;
        double count = 0.0;
        for (const auto half : surface_.halfedges_around_target(surface_.halfedge(vertex))) {
          const Vertex next = surface_.source(half);
          sum += fixed_[next] ? 1.0 : before[next];
          count += 1.0;
        }
        of[vertex] = std::min(before[vertex], 0.5 * (1.0 + sum / count));
      }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) share[i] = of[vertices[i]];
  }

  SurfaceMesh surface_;
  const VertexOrigins& origins_;
  double level_mm_;                                          // of the table
  double edge_mm_;                                           // of the new triangles
  SurfaceMesh::Property_map<Face, int> in_;                  // 1: in a patch
  SurfaceMesh::Property_map<Edge, bool> rim_;                // a patch on one side
  SurfaceMesh::Property_map<Vertex, bool> fixed_;            // not inside a patch, or measured
  SurfaceMesh::Property_map<Vertex, std::uint32_t> number_;  // among the places of the plate
};

UndersidePatches::UndersidePatches(const VertexOrigins& origins,
                                   const std::vector<std::uint32_t>& triangles, double edge_mm)
    : body_(std::make_unique<Body>(origins, triangles, edge_mm)) {}
UndersidePatches::UndersidePatches(const UndersidePatches& other)
    : body_(std::make_unique<Body>(*other.body_)) {}
UndersidePatches::UndersidePatches(UndersidePatches&&) noexcept = default;
UndersidePatches::~UndersidePatches() = default;

std::size_t UndersidePatches::inner() const { return body_->inner().size(); }
void UndersidePatches::divide() { body_->divide(); }
void UndersidePatches::even() { body_->even(); }
void UndersidePatches::spare(const Places& places) { body_->spare(places); }
Places UndersidePatches::crossings() const { return body_->crossings(); }
Places UndersidePatches::spoilt() const { return body_->spoilt(); }

double UndersidePatches::bend(const RimSlopes& slopes, std::size_t allowed, const Task& task) {
  return body_->bend(slopes, allowed, task);
}

ShapedSurface UndersidePatches::surface() const {
  ShapedSurface shaped;
  shaped.mesh = meshOf(body_->surface());
  for (const auto vertex : body_->surface().vertices()) {
    shaped.fixed.push_back(body_->isFixed(vertex) ? 1 : 0);
    shaped.origins.push_back(body_->originOf(vertex));
  }
  std::uint32_t triangle = 0;
  for (const auto face : body_->surface().faces()) {
    if (body_->isIn(face)) shaped.patches.push_back(triangle);
    ++triangle;
  }
  return shaped;
}

}  // namespace gyre
