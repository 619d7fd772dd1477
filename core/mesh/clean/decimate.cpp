// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/decimate.h"

#include <algorithm>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "core/mesh/clean/blend.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/unseen_patch.h"
#include "core/mesh/surface_index.h"

namespace gyre {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::size_t kReportEvery = 1024;  // collapses
constexpr int kMaxRounds = 6;

// Ends when the budget is met or the task is stopped.
class StopAtBudget {
 public:
  StopAtBudget(std::size_t before, std::size_t budget, const Task& task)
      : before_(before), budget_(budget), task_(task) {}

  template <class Cost, class Profile>
  bool operator()(const Cost& /*cost*/, const Profile& profile, std::size_t /*edges_before*/,
                  std::size_t edges) const {
    const std::size_t triangles = profile.surface_mesh().number_of_faces();
    if (edges % kReportEvery == 0) {
      const double done = static_cast<double>(before_ - std::min(before_, triangles));
      task_.report(done / static_cast<double>(before_ - budget_), "Reducing triangles");
    }
    return triangles <= budget_ || task_.stopRequested();
  }

 private:
  std::size_t before_;
  std::size_t budget_;
  const Task& task_;
};

// Lindstrom and Turk's place, but at the held height when an end of the edge lies there.
class HoldingPlacement {
 public:
  explicit HoldingPlacement(double hold_z_mm) : hold_z_mm_(hold_z_mm) {}

  template <class Profile>
  boost::optional<typename Profile::Point> operator()(const Profile& profile) const {
    auto place = free_(profile);
    const bool held = profile.p0().z() == hold_z_mm_ || profile.p1().z() == hold_z_mm_;
    if (place && held) place = typename Profile::Point(place->x(), place->y(), hold_z_mm_);
    return place;
  }

 private:
  sms::LindstromTurk_placement<SurfaceMesh> free_;
  double hold_z_mm_;
};

void collapse(SurfaceMesh& surface, const StopAtBudget& stop, double hold_z_mm) {
  sms::edge_collapse(surface, stop,
                     CGAL::parameters::get_cost(sms::LindstromTurk_cost<SurfaceMesh>())
                         .get_placement(HoldingPlacement(hold_z_mm))
                         .filter(sms::Bounded_normal_change_filter<>()));
}

double largestDistance_mm(const Mesh& from, const Mesh& to) {
  const SurfaceIndex index(to);
  double largest_mm = 0.0;
  for (const MeshVertex& vertex : from.vertices) {
    largest_mm = std::max(largest_mm, index.nearest(vertex.position).distance_mm);
  }
  return largest_mm;
}

}  // namespace

Result<DecimatedMesh> decimateMesh(const Mesh& mesh, const DecimateOptions& options,
                                   const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  if (task.stopRequested()) return cancelled();
  const auto budget = static_cast<std::size_t>(options.triangles);
  if (budget == 0 || mesh.triangles.size() <= budget) return DecimatedMesh{mesh, 0.0};
  return guarded("The reduction of triangles", [&]() -> Result<DecimatedMesh> {
    SurfaceMesh surface = surfaceMeshOf<SurfaceMesh>(mesh);
    DecimatedMesh decimated;
    std::vector<std::uint32_t> to_divide;
    // Every triangle that must be divided to stay unseen becomes three.
    std::size_t wanted = budget;
    for (int round = 0; round < kMaxRounds; ++round) {
      collapse(surface, {mesh.triangles.size(), wanted, task}, options.hold_z_mm);
      if (task.stopRequested()) return cancelled();
      decimated.mesh = meshOf(surface);
      carryAttributes(mesh, decimated.mesh);
      to_divide = seenOverUnseen(mesh, decimated.mesh);
      const std::size_t count = decimated.mesh.triangles.size() + 2 * to_divide.size();
      if (count <= budget || 2 * to_divide.size() >= budget) break;
      const std::size_t left = std::min(wanted, decimated.mesh.triangles.size());
      wanted = left - std::min(left, count - budget);
    }
    divideSeenTriangles(decimated.mesh, to_divide);
    computeNormals(decimated.mesh);
    decimated.largest_move_mm = largestDistance_mm(decimated.mesh, mesh);
    return decimated;
  });
}

}  // namespace gyre
