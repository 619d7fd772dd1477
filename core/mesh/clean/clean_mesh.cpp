// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/clean_mesh.h"

#include <cmath>
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

class Cleaner {
 public:
  Cleaner(const Mesh& mesh, const CleanOptions& options, const Task& task)
      : options_(linked(options)), task_(task) {
    cleaned_.mesh = mesh;
    cleaned_.report.before = meshHealth(mesh);
  }

  Result<CleanedMesh> run() {
    using Step = Result<void> (Cleaner::*)(const Task&);
    constexpr Step kSteps[] = {&Cleaner::merge,    &Cleaner::dropSmallPieces,
                               &Cleaner::split,    &Cleaner::orient,
                               &Cleaner::crop,     &Cleaner::fill,
                               &Cleaner::cap,      &Cleaner::smooth,
                               &Cleaner::decimate, &Cleaner::remesh};
    const double all = std::size(kSteps);
    double done = 0.0;
    for (const Step step : kSteps) {
      if (task_.stopRequested()) return cancelled();
      const Task part = task_.part(done / all, (done + 1.0) / all);
      if (const Result<void> stepped = (this->*step)(part); !stepped) return stepped.error();
      ++done;
    }
    computeNormals(cleaned_.mesh);
    cleaned_.report.after = meshHealth(cleaned_.mesh);
    return std::move(cleaned_);
  }

 private:
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

}  // namespace

bool changesShape(const CleanOptions& options) {
  return isCut(options.crop) || options.holes.max_width_mm > 0.0 || options.base_cap ||
         options.smooth.iterations > 0 || options.decimate.triangles > 0 ||
         options.remesh.edge_mm > 0.0;
}

Result<CleanedMesh> cleanMesh(const Mesh& mesh, const CleanOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  return Cleaner(mesh, options, task).run();
}

}  // namespace gyre
