// A picture of how far a result lies from a reference: from several sides, with what it means.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scan/comparison.h"
#include "core/scan/mesh.h"

namespace gyre {

// One of the two shapes, and how far each of its vertices lies from the other one.
struct PaintedShape {
  std::string title;
  const Mesh& shape;  // where it was compared
  const std::vector<double>& distances_mm;
};

// A row of four sides for each shape, in the colours of distanceColour() up to the comparison's
// scale, and below them the scale, the histogram and the figures. Replaces the PNG atomically.
Result<void> writeComparisonPicture(const std::filesystem::path& file,
                                    const std::vector<PaintedShape>& shapes,
                                    const Comparison& comparison);

// The comparison in sentences, as the command says it.
std::string comparisonText(const Comparison& comparison);

}  // namespace gyre
