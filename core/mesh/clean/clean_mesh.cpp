// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/clean_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/clean/base_cap.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/crop.h"
#include "core/mesh/clean/decimate.h"
#include "core/mesh/clean/fill_holes.h"
#include "core/mesh/clean/merge_vertices.h"
#include "core/mesh/clean/orient.h"
#include "core/mesh/clean/remesh.h"
#include "core/mesh/clean/smooth.h"
#include "core/mesh/clean/split_non_manifold.h"
#include "core/mesh/components.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

using Figures = std::vector<CleanFigure>;

CleanFigure count(const std::string& what, std::size_t number) {
  return {what, static_cast<double>(number), ""};
}

bool isCut(const CropOptions& crop) {
  const auto cuts = [](double limit_mm) { return std::abs(limit_mm) < kNoCrop_mm; };
  return crop.radius_mm > 0.0 || cuts(crop.x_min_mm) || cuts(crop.x_max_mm) ||
         cuts(crop.y_min_mm) || cuts(crop.y_max_mm) || cuts(crop.z_min_mm) || cuts(crop.z_max_mm);
}

// The options with what one step must know of another: where the base is, or where it was cut.
CleanOptions linked(CleanOptions options) {
  const bool has_base = options.base_cap || std::abs(options.crop.z_min_mm) < kNoCrop_mm;
  const double base_z_mm = options.base_cap ? options.base.z_mm : options.crop.z_min_mm;
  if (options.base_cap) options.holes.spare_below_mm = base_z_mm + options.base.tolerance_mm;
  if (has_base && options.smooth.hold_z_mm == kNoCrop_mm) options.smooth.hold_z_mm = base_z_mm;
  if (has_base && options.decimate.hold_z_mm == kNoCrop_mm) options.decimate.hold_z_mm = base_z_mm;
  return options;
}

CleanedMesh begun(const Mesh& mesh) {
  CleanedMesh cleaned;
  cleaned.mesh = mesh;
  cleaned.report.before = meshHealth(mesh);
  return cleaned;
}

class Cleaner {
 public:
  // options: linked. state: as the steps before the first one to be run left it.
  Cleaner(CleanedMesh state, const CleanOptions& options, const Task& task)
      : options_(options), task_(task), cleaned_(std::move(state)) {}

  // The first step, up to `end`, that does something else by one than by the other linked options.
  static std::size_t firstOther(const CleanOptions& a, const CleanOptions& b, std::size_t end) {
    std::size_t step = 0;
    while (step < end && kSteps[step].same(a, b)) ++step;
    return step;
  }

  // After each step calls noteStep(step, what the steps made so far).
  template <class NoteStep>
  Result<CleanedMesh> run(std::size_t first_step, const NoteStep& noteStep) {
    constexpr double kAll = kCleanSteps;
    for (std::size_t step = first_step; step < kCleanSteps; ++step) {
      if (task_.stopRequested()) return cancelled();
      const auto done = static_cast<double>(step);
      const Task part = task_.part(done / kAll, (done + 1.0) / kAll);
      if (const Result<void> stepped = (this->*kSteps[step].make)(part); !stepped) {
        return stepped.error();
      }
      noteStep(step, cleaned_);
    }
    computeNormals(cleaned_.mesh);
    cleaned_.report.after = meshHealth(cleaned_.mesh);
    return std::move(cleaned_);
  }

 private:
  using Options = CleanOptions;
  struct Step {
    Result<void> (Cleaner::*make)(const Task&);
    bool (*same)(const Options& a, const Options& b);  // its own options
  };
  static const std::array<Step, kCleanSteps> kSteps;

  // Takes over what a step made and notes what it did.
  void take(const std::string& name, Mesh made, Figures figures) {
    cleaned_.report.steps.push_back(
        {name, cleaned_.mesh.triangles.size(), made.triangles.size(), std::move(figures)});
    cleaned_.mesh = std::move(made);
  }

  Result<void> merge(const Task& task) {
    auto made = mergeVertices(cleaned_.mesh, options_.merge, task);
    if (!made) return made.error();
    take("Merge", std::move(made->mesh),
         {count("vertices merged", made->vertices_merged),
          count("triangles removed", made->triangles_removed)});
    return {};
  }

  Result<void> dropSmallPieces(const Task& task) {
    if (options_.min_component_share == 0.0) return {};
    task.report(0.0, "Removing small pieces");
    Mesh made = cleaned_.mesh;
    removeSmallComponents(made, options_.min_component_share);
    const std::size_t before = findComponents(cleaned_.mesh).area_mm2.size();
    const std::size_t after = findComponents(made).area_mm2.size();
    take("Small pieces", std::move(made), {count("pieces removed", before - after)});
    return {};
  }

  Result<void> split(const Task& task) {
    if (!options_.split_non_manifold) return {};
    auto made = splitNonManifold(cleaned_.mesh, task);
    if (!made) return made.error();
    take("Separate", std::move(made->mesh),
         {count("vertices added", made->vertices_added),
          count("triangles removed", made->triangles_removed)});
    return {};
  }

  Result<void> orient(const Task& task) {
    if (!options_.orient) return {};
    auto made = orientOutwards(cleaned_.mesh, task);
    if (!made) return made.error();
    take("Orient", std::move(made->mesh),
         {count("triangles turned", made->triangles_turned),
          count("vertices added", made->vertices_added),
          count("triangles removed", made->triangles_removed)});
    return {};
  }

  // Surfaces may be left that touch in a point of the cut, and crumbs.
  Result<void> crop(const Task& task) {
    if (!isCut(options_.crop)) return {};
    auto made = cropMesh(cleaned_.mesh, options_.crop, task);
    if (!made) return made.error();
    take("Crop", std::move(made->mesh),
         {count("triangles removed", made->triangles_removed),
          count("triangles cut", made->triangles_cut)});
    if (cleaned_.mesh.triangles.empty()) {
      return Error{Error::Code::kTooFew, "The crop leaves nothing of the mesh.",
                   "Crop less: the object lies outside the limits."};
    }
    if (!checkSurface(cleaned_.mesh)) {
      if (const Result<void> separated = split(task); !separated) return separated;
    }
    return dropSmallPieces(task);
  }

  Result<void> fill(const Task& task) {
    if (options_.holes.max_width_mm == 0.0) return {};
    auto made = fillHoles(cleaned_.mesh, options_.holes, task);
    if (!made) return made.error();
    take("Fill holes", std::move(made->mesh),
         {count("holes filled", made->holes_filled),
          count("holes left", made->holes_left),
          {"area filled", made->filled_mm2, "mm^2"}});
    return {};
  }

  Result<void> cap(const Task& task) {
    if (!options_.base_cap) return {};
    auto made = capBase(cleaned_.mesh, options_.base, task);
    if (!made) return made.error();
    take("Base", std::move(made->mesh),
         {count("rims closed", made->rims_closed),
          {"area of the base", made->base_mm2, "mm^2"},
          {"highest rim above the base", made->tallest_skirt_mm, "mm"}});
    return {};
  }

  Result<void> smooth(const Task& task) {
    if (options_.smooth.iterations == 0) return {};
    auto made = smoothMesh(cleaned_.mesh, options_.smooth, task);
    if (!made) return made.error();
    take("Smooth", std::move(made->mesh),
         {{"median move", made->median_move_mm, "mm"},
          {"largest move", made->largest_move_mm, "mm"},
          {"vertices held by their sigma", 100.0 * made->at_bound_share, "%"}});
    return {};
  }

  Result<void> decimate(const Task& task) {
    if (options_.decimate.triangles == 0) return {};
    auto made = decimateMesh(cleaned_.mesh, options_.decimate, task);
    if (!made) return made.error();
    take("Reduce", std::move(made->mesh),
         {{"largest distance from the surface", made->largest_move_mm, "mm"}});
    return {};
  }

  Result<void> remesh(const Task& task) {
    if (options_.remesh.edge_mm == 0.0) return {};
    auto made = remeshEvenly(cleaned_.mesh, options_.remesh, task);
    if (!made) return made.error();
    take("Remesh", std::move(made->mesh), {{"mean edge", made->mean_edge_mm, "mm"}});
    return {};
  }

  const CleanOptions options_;
  const Task& task_;
  CleanedMesh cleaned_;
};

const std::array<Cleaner::Step, kCleanSteps> Cleaner::kSteps = {{
    {&Cleaner::merge, [](const Options& a, const Options& b) { return a.merge == b.merge; }},
    {&Cleaner::dropSmallPieces,
     [](const Options& a, const Options& b) {
       return a.min_component_share == b.min_component_share;
     }},
    {&Cleaner::split,
     [](const Options& a, const Options& b) {
       return a.split_non_manifold == b.split_non_manifold;
     }},
    {&Cleaner::orient, [](const Options& a, const Options& b) { return a.orient == b.orient; }},
    {&Cleaner::crop, [](const Options& a, const Options& b) { return a.crop == b.crop; }},
    {&Cleaner::fill, [](const Options& a, const Options& b) { return a.holes == b.holes; }},
    {&Cleaner::cap, [](const Options& a,
                       const Options& b) { return a.base_cap == b.base_cap && a.base == b.base; }},
    {&Cleaner::smooth, [](const Options& a, const Options& b) { return a.smooth == b.smooth; }},
    {&Cleaner::decimate,
     [](const Options& a, const Options& b) { return a.decimate == b.decimate; }},
    {&Cleaner::remesh, [](const Options& a, const Options& b) { return a.remesh == b.remesh; }},
}};

}  // namespace

bool changesShape(const CleanOptions& options) {
  return isCut(options.crop) || options.holes.max_width_mm > 0.0 || options.base_cap ||
         options.smooth.iterations > 0 || options.decimate.triangles > 0 ||
         options.remesh.edge_mm > 0.0;
}

Result<CleanedMesh> cleanMesh(const Mesh& mesh, const CleanOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  return Cleaner(begun(mesh), linked(options), task).run(0, [](std::size_t, const CleanedMesh&) {});
}

Result<CleanedMesh> RepeatedCleanUp::run(const MeshPtr& mesh, const CleanOptions& options,
                                         const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (mesh != mesh_) {
    if (const Result<void> checked = checkMesh(*mesh); !checked) return checked.error();
    after_ = {};
    begun_ = std::make_shared<const CleanedMesh>(begun(*mesh));
    mesh_ = mesh;
  }
  const CleanOptions wanted = linked(options);
  const auto made =
      static_cast<std::size_t>(std::find(after_.begin(), after_.end(), nullptr) - after_.begin());
  const std::size_t first = Cleaner::firstOther(wanted, options_, made);
  std::fill(after_.begin() + static_cast<std::ptrdiff_t>(first), after_.end(), nullptr);
  options_ = wanted;
  CleanedPtr last = first == 0 ? begun_ : after_[first - 1];
  return Cleaner(*last, wanted, task).run(first, [&](std::size_t step, const CleanedMesh& now) {
    const bool changed = now.report.steps.size() != last->report.steps.size();
    if (changed) last = std::make_shared<const CleanedMesh>(now);
    after_[step] = last;
  });
}

}  // namespace gyre
