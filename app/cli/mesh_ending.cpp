// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/mesh_ending.h"

#include <cmath>
#include <string>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr double kToldMove_mm = 0.0005;

std::string methodText(const MadeMesh& made) {
  switch (made.method) {
    case MeshMethod::kAlpha:
      return formatted("Alpha shape, alpha %.3g mm", made.alpha_mm);
    case MeshMethod::kAdaptive:
      return "Adaptive alpha shape";
    case MeshMethod::kWatertight:
      return formatted("Wrap, alpha %.3g mm", made.alpha_mm);
    case MeshMethod::kPoisson:
      return "Poisson surface";
    case MeshMethod::kSilhouette:
      return "Body from outlines";
    case MeshMethod::kClosed:
    case MeshMethod::kAuto:
      break;
  }
  return "Visibility cut";
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string healthText(const MeshHealth& health) {
  std::string text = counted(health.vertices, "vertex", "vertices") + ", " +
                     counted(health.triangles, "triangle", "triangles") + ", " +
                     counted(health.components, "component", "components") + ", ";
  if (health.closed) {
    text += "closed";
    if (health.genus)
      text += ", " + counted(static_cast<std::size_t>(*health.genus), "tunnel", "tunnels");
    text += formatted(", %.4g cm^3", health.volume_mm3 / 1000.0);
  } else {
    text += "open where no camera looked (" + counted(health.holes, "rim", "rims") + ")";
  }
  if (health.self_intersections.value_or(0) > 0) {
    text +=
        formatted(", passes through itself at %zu pairs of triangles", *health.self_intersections);
  } else if (health.self_intersections) {
    text += ", free of self-intersections";
  }
  text += formatted(", %.4g cm^2", health.area_mm2 / 100.0);
  if (health.area_mm2 > 0.0) {
    text += formatted(", %.1f %% of it not seen", 100.0 * health.unseen_area_mm2 / health.area_mm2);
  }
  return text + ".";
}

std::string stepText(const CleanStep& step) {
  std::string text = step.name + ": ";
  for (const CleanFigure& figure : step.figures) {
    text += figure.what + " " + formatted("%.4g", figure.value);
    if (!figure.unit.empty()) text += " " + figure.unit;
    text += ", ";
  }
  return text + counted(step.triangles_after, "triangle", "triangles") + ".";
}

}  // namespace

void tellMesh(Console& console, const MadeMesh& made, const MeshHealth& health,
              const std::optional<CleanReport>& cleaned, double moved_mm) {
  if (cleaned) {
    for (const CleanStep& step : cleaned->steps) console.say(stepText(step));
  }
  console.say(methodText(made) + ": " + healthText(health));
  if (std::abs(moved_mm) >= kToldMove_mm) {
    console.say(formatted("Moved by %.3f mm along z to stand on the bed.", moved_mm));
  }
}

}  // namespace gyre
