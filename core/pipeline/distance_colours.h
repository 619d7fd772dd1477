// Colours that stand for distances: even steps of distance look like even steps of colour.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "core/scan/mesh.h"

namespace gyre {

// From 0 to the scale's end: viridis, dark violet over green to yellow, told apart by the
// colour-blind and in grey as well.
const std::array<Rgb, 256>& distanceColours();

// Of a distance; beyond the scale that of its end. scale_mm > 0; no number gives grey.
Rgb distanceColour(double distance_mm, double scale_mm);

// Gives each vertex the colour of its distance.
void colourByDistance(Mesh& mesh, std::span<const double> distances_mm, double scale_mm);

}  // namespace gyre
