// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sheet_print.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace gyre {
namespace {

constexpr float kBin_mm = 1.5F;
constexpr int kMostBins = 512;  // a side

// Distance of a coordinate from the nearest line of its grid, in cells.
Eigen::Array2f offLines(const Eigen::Array2f& cells) { return (cells - cells.round()).abs(); }

}  // namespace

SheetPrint::SheetPrint(const Eigen::Vector2d& half_size)
    : half_size_(half_size.cast<float>()),
      bins_a_side_((2.0F * half_size_.array() / kBin_mm).ceil().cast<int>().max(1).min(kMostBins)),
      bins_(static_cast<std::size_t>(bins_a_side_.prod())) {}

SheetPrint::Grid SheetPrint::gridOf(const Eigen::Vector2d& origin, const Eigen::Matrix2d& step) {
  Grid grid;
  const Eigen::Matrix2d cells_from_mm = step.inverse();
  grid.origin = origin.cast<float>();
  grid.cells_from_mm = cells_from_mm.cast<float>();
  grid.mm_per_cell = cells_from_mm.rowwise().norm().array().inverse().cast<float>();
  return grid;
}

const SheetPrint::Bin& SheetPrint::binAt(const Eigen::Vector2f& place) const {
  const Eigen::Array2f share = 0.5F * ((place.array() / half_size_.array()) + 1.0F);
  const Eigen::Array2i at = (share * bins_a_side_.cast<float>()).floor().cast<int>();
  if ((at < 0).any() || (at >= bins_a_side_).any()) return nothing_;
  return bins_[static_cast<std::size_t>(at.y() * bins_a_side_.x() + at.x())];
}

template <class Enter>
void SheetPrint::enterBins(const Eigen::Vector2d& centre, double radius_mm, const Enter& enter) {
  const Eigen::Array2d half = half_size_.cast<double>().array();
  const Eigen::Array2d per_mm = bins_a_side_.cast<double>() / (2.0 * half);
  const double reach = radius_mm + static_cast<double>(kReach_mm);
  const auto bin = [&](const Eigen::Array2d& place) -> Eigen::Array2i {
    return ((place + half) * per_mm).floor().cast<int>().max(0).min(bins_a_side_ - 1);
  };
  const Eigen::Array2i from = bin(centre.array() - reach);
  const Eigen::Array2i to = bin(centre.array() + reach);
  for (int y = from.y(); y <= to.y(); ++y) {
    for (int x = from.x(); x <= to.x(); ++x) {
      enter(bins_[static_cast<std::size_t>(y * bins_a_side_.x() + x)]);
    }
  }
}

void SheetPrint::set(const SquareLattice& lattice) {
  lattice_ = lattice;
  lattice_grid_ = gridOf(lattice.origin, lattice.step);
  has_lattice_ = true;
}

void SheetPrint::add(const SheetCode& code) {
  const auto index = static_cast<std::uint32_t>(codes_.size());
  codes_.push_back({gridOf(code.origin, code.module), code.modules_a_side, code.modules});
  const Eigen::Vector2d diagonal =
      code.module * Eigen::Vector2d::Constant(static_cast<double>(code.modules_a_side));
  enterBins(code.origin + 0.5 * diagonal, 0.5 * diagonal.norm(),
            [&](Bin& bin) { bin.codes.push_back(index); });
}

void SheetPrint::add(const SheetDot& dot) {
  const auto index = static_cast<std::uint32_t>(dots_.size());
  const Eigen::Vector2f centre = dot.centre.cast<float>();
  dots_.push_back({centre, static_cast<float>(dot.radius_mm), !squareIsDark(centre)});
  enterBins(dot.centre, dot.radius_mm, [&](Bin& bin) { bin.dots.push_back(index); });
}

bool SheetPrint::squareIsDark(const Eigen::Vector2f& place) const {
  if (!has_lattice_) return false;
  const Eigen::Array2i square = lattice_grid_.cells(place).floor().cast<int>();
  if ((square < lattice_.first).any() || (square > lattice_.last).any()) return false;
  return ((square.sum() - lattice_.dark_parity) & 1) == 0;
}

bool SheetPrint::isDark(const Eigen::Vector2f& place) const {
  const Bin& bin = binAt(place);
  for (const std::uint32_t index : bin.codes) {
    const Code& code = codes_[index];
    const Eigen::Array2i at = code.grid.cells(place).floor().cast<int>();
    if ((at < 0).any() || (at >= code.side).any()) continue;
    return code.modules[static_cast<std::size_t>(at.y() * code.side + at.x())] == 0;
  }
  for (const std::uint32_t index : bin.dots) {
    if ((place - dots_[index].centre).norm() <= dots_[index].radius) return dots_[index].dark;
  }
  return squareIsDark(place);
}

float SheetPrint::clearance(const Eigen::Vector2f& place) const {
  float clear = kReach_mm;
  if (has_lattice_) {
    const Eigen::Array2f off = offLines(lattice_grid_.cells(place)) * lattice_grid_.mm_per_cell;
    clear = std::min(clear, off.minCoeff());
  }
  const Bin& bin = binAt(place);
  for (const std::uint32_t index : bin.codes) {
    const Code& code = codes_[index];
    const Eigen::Array2f at = code.grid.cells(place);
    const Eigen::Array2f outside = (-at).max(at - static_cast<float>(code.side));
    const float off = (outside > 0.0F).any()
                          ? (outside.max(0.0F) * code.grid.mm_per_cell).maxCoeff()
                          : (offLines(at) * code.grid.mm_per_cell).minCoeff();
    clear = std::min(clear, off);
  }
  for (const std::uint32_t index : bin.dots) {
    const Dot& dot = dots_[index];
    clear = std::min(clear, std::abs((place - dot.centre).norm() - dot.radius));
  }
  return clear;
}

}  // namespace gyre
