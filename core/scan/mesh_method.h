// The ways to make a surface of points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace gyre {

enum class MeshMethod {
  kAuto,        // the program's choice, which it tells
  kAlpha,       // outer facets of an alpha shape: open where nobody looked
  kAdaptive,    // the same with an alpha that follows the spacing of the points
  kClosed,      // visibility cut: a closed body that no line of sight passes through
  kSilhouette,  // visual hull: the body that the outlines leave, hollows filled
  kPoisson,     // a smooth closed surface that follows the normals
  kWatertight,  // a closed skin wrapped around one of the others: the repair
};

inline constexpr std::array<std::pair<MeshMethod, std::string_view>, 7> kMeshMethodWords = {
    {{MeshMethod::kAuto, "auto"},
     {MeshMethod::kAlpha, "alpha"},
     {MeshMethod::kAdaptive, "adaptive"},
     {MeshMethod::kClosed, "closed"},
     {MeshMethod::kWatertight, "watertight"},
     {MeshMethod::kPoisson, "poisson"},
     {MeshMethod::kSilhouette, "silhouette"}}};

// As on the command line and in files.
constexpr std::string_view wordOf(MeshMethod method) {
  for (const auto& [each, word] : kMeshMethodWords) {
    if (each == method) return word;
  }
  return "auto";
}

constexpr std::optional<MeshMethod> meshMethodOf(std::string_view word) {
  for (const auto& [method, each] : kMeshMethodWords) {
    if (each == word) return method;
  }
  return std::nullopt;
}

}  // namespace gyre
