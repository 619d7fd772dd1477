// Lines of a net that is cut out, folded and glued.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "core/calib/targets/print_drawing.h"

namespace gyre {

void cutLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, PrintDrawing& net);
void foldLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, PrintDrawing& net);
void cutCircle(const Eigen::Vector2d& centre, double radius_mm, PrintDrawing& net);

// A tongue to be glued, hinged on the edge, on the left of the way from `from` to `to` as it looks
// on the page, with slanted ends so that it slips behind its neighbour.
void flap(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double depth_mm,
          PrintDrawing& net);

// Words on a part that carries no print.
void label(const Eigen::Vector2d& centre, const std::string& words, PrintDrawing& net);

}  // namespace gyre
